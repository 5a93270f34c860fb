"""The two programs: a git revision in a worktree of its own, and the present tree."""
import os
import subprocess

PROGRAM = "build/release/placegraph"


class BuildError(Exception):
    pass


def run(arguments, cwd, log):
    with open(log, "ab") as file:
        file.write((" ".join(arguments) + "\n").encode())
        file.flush()
        code = subprocess.run(arguments, cwd=cwd, stdin=subprocess.DEVNULL, stdout=file, stderr=file, check=False).returncode
    if code:
        raise BuildError(f"{' '.join(arguments)}: exit code {code}; see {log}")


def build(tree, log):
    """The program of a source tree, built with the preset release."""
    run(["cmake", "--preset", "release"], tree, log)
    run(["cmake", "--build", "--preset", "release", "--target", "placegraph_cli", f"-j{os.cpu_count()}"], tree, log)
    return os.path.join(tree, PROGRAM)


def revision_of(root, name):
    found = subprocess.run(["git", "rev-parse", "--verify", "--quiet", name + "^{commit}"], cwd=root, text=True, capture_output=True, check=False)
    if found.returncode:
        raise BuildError(f"{name}: is no git revision")
    return found.stdout.strip()


def build_base(root, out, name):
    revision = revision_of(root, name)
    tree = os.path.join(out, "base-" + revision[:10])
    log = os.path.join(out, "base.log")
    if not os.path.exists(os.path.join(tree, "CMakeLists.txt")):
        run(["git", "worktree", "prune"], root, log)
        run(["git", "worktree", "add", "--detach", "--force", tree, revision], root, log)
    return build(tree, log)
