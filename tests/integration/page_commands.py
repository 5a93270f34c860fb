"""page_commands.py PAGE PROGRAM: runs every `sh` block of a page of docs/ in its order.

The blocks run in an empty folder with the folder of PROGRAM first on PATH, as a reader would copy them.
The first command that fails ends the test with exit code 1 and the line of the page.
"""
import os
import re
import subprocess
import sys
import tempfile


def blocks_of(page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    for match in re.finditer(r"^```sh\n(.*?)^```", text, re.M | re.S):
        yield text.count("\n", 0, match.start(1)) + 1, match.group(1)


def main():
    page, program = sys.argv[1], os.path.abspath(sys.argv[2])
    environment = dict(os.environ, PATH=os.path.dirname(program) + os.pathsep + os.environ["PATH"])
    blocks = list(blocks_of(page))
    with tempfile.TemporaryDirectory() as folder:
        for line, block in blocks:
            if block.startswith("export PATH="):
                continue  # PATH is that of the program under test
            run = subprocess.run(["sh", "-eu", "-c", block], cwd=folder, env=environment,
                                 capture_output=True, text=True)
            if run.returncode != 0:
                print(f"{page}:{line}: exit code {run.returncode}\n{run.stdout}{run.stderr}")
                sys.exit(1)
    if not blocks:
        print(f"{page}: no block of commands")
        sys.exit(1)
    print(f"{page}: {len(blocks)} blocks of commands work")


if __name__ == "__main__":
    main()
