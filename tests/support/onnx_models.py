"""onnx_models.py KIND FILE: writes a small network as an ONNX file, without any package.

  gradients  the histograms of gradient orientation of frontend/places/cues/gradient_layout.h, for a grey image of
             96 x 72 pixels: 9 rows of 12 cells of 9 orientations
  mean       the mean of each channel of a colour image of 24 x 16 pixels
  any        the same of an image of any size
  last       the values themselves of an image of 3 x 2 pixels, whose channels are the last dimension
  unknown    an operator that no program knows
  list       takes a list of numbers instead of a picture

An ONNX file is a message of protocol buffers; the numbers of the fields are those of onnx.proto.
"""
import struct
import sys

FLOAT, INT, STRING, INTS = 1, 2, 3, 7  # types of attributes


def number(value):
    """Seven bits a byte; all but the last one have the eighth."""
    value &= (1 << 64) - 1
    out = bytearray()
    while value >= 0x80:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def field(key, value):
    """A field of a message: a number, a text, or a message."""
    if isinstance(value, int):
        return number(key << 3) + number(value)
    if isinstance(value, float):
        return number(key << 3 | 5) + struct.pack("<f", value)
    data = value.encode() if isinstance(value, str) else value
    return number(key << 3 | 2) + number(len(data)) + data


def attribute(name, value):
    if isinstance(value, list):
        return field(1, name) + b"".join(field(8, v) for v in value) + field(20, INTS)
    kind, key = {int: (INT, 3), float: (FLOAT, 2), str: (STRING, 4)}[type(value)]
    return field(1, name) + field(key, value) + field(20, kind)


def shape_of(name, sizes):
    """A ValueInfoProto of floats; a size that is a text is any."""
    dimensions = b"".join(field(1, field(2 if isinstance(s, str) else 1, s)) for s in sizes)
    return field(1, name) + field(2, field(1, field(1, FLOAT) + field(2, dimensions)))


class Graph:
    """Operators, each of which gets a name for its output."""

    def __init__(self, sizes):
        self.nodes, self.weights, self.names = b"", b"", 0
        self.head = field(11, shape_of("image", sizes))

    def name(self):
        self.names += 1
        return f"n{self.names}"

    def constant(self, sizes, values, kind=FLOAT):
        name = self.name()
        data = struct.pack(f"<{len(values)}{'f' if kind == FLOAT else 'q'}", *values)
        self.weights += field(5, b"".join(field(1, s) for s in sizes) + field(2, kind) + field(8, name) + field(9, data))
        return name

    def __call__(self, operator, *inputs, **attributes):
        name = self.name()
        self.nodes += field(1, b"".join(field(1, i) for i in inputs) + field(2, name) + field(3, name) + field(4, operator)
                            + b"".join(field(5, attribute(k, v)) for k, v in attributes.items()))
        return name

    def mix(self, values, weights, bias=None):
        """A linear map of the channels: a row of `weights` for each channel of the result."""
        rows, columns = len(weights), len(weights[0])
        constants = [self.constant([rows, columns, 1, 1], [w for row in weights for w in row])]
        constants.append(self.constant([rows], bias or [0] * rows))
        return self("Conv", values, *constants, kernel_shape=[1, 1])

    def bytes_of(self, output, sizes):
        named = self.nodes + field(2, "graph") + self.weights + self.head + field(12, shape_of(output, sizes))
        return field(1, 5) + field(7, named) + field(8, field(2, 10))


def orientation_bins(graph, dx, dy, orientations):
    """Shares of each orientation, times the magnitude. dx and dy are whole numbers, as their steps are made of that."""
    def relu(values):
        return graph("Relu", values)

    both = graph("Concat", dx, dy, axis=1)
    parts = relu(graph.mix(both, [[1, 0], [-1, 0], [0, 1], [0, -1]]))
    lengths = graph.mix(parts, [[1, 1, 0, 0], [0, 0, 1, 1]])  # |dx|, |dy|
    magnitude = graph("Sqrt", graph.mix(graph("Mul", both, both), [[1, 1]]))
    # The least and the greatest of both, and whether |dx| is the greatest.
    ramps = relu(graph.mix(lengths, [[1, 0], [0, 1], [1, -1], [1, -1]], [0, 0, 0, 1]))
    least, greatest = graph.mix(ramps, [[1, 0, -1, 0]]), graph.mix(ramps, [[0, 1, 1, 0]], [1e-12])
    flat = graph.mix(ramps, [[0, 0, -1, 1]])
    # The polynomial of OpenCV's fastAtan2 [deg].
    c = graph("Div", least, greatest)
    square = graph("Mul", c, c)
    angle = graph.mix(square, [[-2.539723330]], [8.914000620])
    for coefficient in (-18.66744615, 57.28362735):
        angle = graph.mix(graph("Mul", angle, square), [[1]], [coefficient])
    angle = graph("Mul", angle, c)
    # Of steep gradients it is 90 less the angle, of those to the upper right 180 less it.
    angle = graph("Add", graph.mix(angle, [[-1]], [90]), graph("Mul", flat, graph.mix(angle, [[2]], [-90])))
    product = graph("Mul", dx, dy)
    steps = relu(graph.mix(product, [[-1], [-1]], [0, -1]))
    angle = graph("Add", angle, graph("Mul", graph.mix(steps, [[1, -1]]), graph.mix(angle, [[-2]], [180])))
    # Each gradient counts in the two nearest of the orientations, of which the first is behind the last.
    scale, count = orientations / 180, orientations + 1
    distances = relu(graph.mix(angle, [[scale]] * count + [[-scale]] * count, [-k for k in range(count)] + list(range(count))))
    shares = relu(graph.mix(distances, [[-1.0 if j % count == k else 0 for j in range(2 * count)] for k in range(count)], [1] * count))
    shares = graph.mix(shares, [[1.0 if j % orientations == k else 0 for j in range(count)] for k in range(orientations)])
    return graph("Mul", shares, graph.mix(magnitude, [[1]] * orientations))


def gradients(columns=12, rows=9, cell=8, orientations=9):
    graph = Graph([1, 1, rows * cell, columns * cell])
    padded = graph("Pad", "image", mode="reflect", pads=[0, 0, 1, 1, 0, 0, 1, 1])

    def difference(kernel):
        return graph("Conv", padded, graph.constant([1, 1, 3, 3], kernel), kernel_shape=[3, 3])

    bins = orientation_bins(graph, difference([0, 0, 0, -1, 0, 1, 0, 0, 0]), difference([0, -1, 0, 0, 0, 0, 0, 1, 0]), orientations)
    # Each pixel counts in the four nearest cells.
    side = 2 * cell
    ramp = [1 - abs(i + 0.5 - cell) / cell for i in range(side)]
    kernel = graph.constant([orientations, 1, side, side], [a * b for a in ramp for b in ramp] * orientations)
    cells = graph("Conv", bins, kernel, kernel_shape=[side, side], strides=[cell, cell], group=orientations, pads=[cell // 2] * 4)
    # The length of the neighbourhood of 3 x 3 cells, where those at the border count for those beyond it.
    count = rows * columns
    mean = [0.0] * (count * count)
    for y in range(rows):
        for x in range(columns):
            for dy in (-1, 0, 1):
                for dx in (-1, 0, 1):
                    beside = min(max(y + dy, 0), rows - 1) * columns + min(max(x + dx, 0), columns - 1)
                    mean[beside * count + y * columns + x] += 1 / 9
    energy = graph.mix(graph("Mul", cells, cells), [[1] * orientations])
    energy = graph("Sqrt", graph("MatMul", graph("Flatten", energy, axis=1), graph.constant([count, count], mean)))
    # A tenth of the mean is added.
    floor = [0.1 / count + (1.0 if i % (count + 1) == 0 else 0) for i in range(count * count)]
    energy = graph("MatMul", energy, graph.constant([count, count], floor))
    energy = graph("Reshape", energy, graph.constant([4], [1, 1, rows, columns], INTS))
    shares = graph("Div", cells, graph.mix(energy, [[1]] * orientations, [1e-6] * orientations))
    shares = graph("Clip", shares, min=0.0, max=1.0)
    output = graph("Flatten", graph("Transpose", shares, perm=[0, 2, 3, 1]), axis=1)
    return graph.bytes_of(output, [1, count * orientations])


def mean_of(sizes):
    graph = Graph(sizes)
    output = graph("Flatten", graph("GlobalAveragePool", "image"), axis=1)
    return graph.bytes_of(output, [1, 3])


def one(operator, sizes, result, **attributes):
    graph = Graph(sizes)
    return graph.bytes_of(graph(operator, "image", **attributes), result)


KINDS = {
    "gradients": gradients,
    "mean": lambda: mean_of([1, 3, 16, 24]),
    "any": lambda: mean_of(["batch", 3, "height", "width"]),
    "last": lambda: one("Flatten", [1, 2, 3, 3], [1, 18], axis=1),
    "unknown": lambda: one("Frobnicate", [1, 3, 16, 24], [1, 3]),
    "list": lambda: one("Relu", [1, 16], [1, 16]),
}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in KINDS:
        sys.exit(__doc__)
    with open(sys.argv[2], "wb") as file:
        file.write(KINDS[sys.argv[1]]())
