"""docstrings_selftest.py LINT: docstrings.py passes a clean tree and catches what is planted."""
import os
import subprocess
import sys
import tempfile

LINT = sys.argv[1]


def header(text, includes=""):
    return f'#pragma once\n{includes}\nnamespace [[gnu::visibility("default")]] placegraph {{\n{text}\n}}\n'


# file: content; of the tree that has no fault
CLEAN = {
    "graph/pose.h": header("""
/// A pose of the plane:
///   T = (R, t)
struct Pose {
  double x = 0, y = 0;  ///< [m]
  /// Of the x axis [rad].
  double heading = 0;
  /// Names no pose.
  enum class Kind { kNone, kPlane };
  Kind kind = Kind::kNone;  ///< as it was read
  /// The numbers that it needs.
  struct Numbers {
    int count = 3;  ///< of the tangent
  } numbers;
  void check() const;
  bool operator==(const Pose&) const = default;
  friend auto operator<=>(const Pose&, const Pose&) = default;
};

struct OptionVisitor;
void visit(OptionVisitor& field, Pose& pose);

/// A list of things.
template <class T>
class List {
 public:
  List() = default;
  /// Of that many things.
  explicit List(int size);
  List(const List&);
  List(List&&) noexcept;
  List(double) = delete;
  List& operator=(const List&);
  ~List();
  /// How many there are.
  int size() const { return size_; }
  /// Writes them.
  friend void write(const List&) {}

 protected:
  int capacity() const;

 private:
  struct Node {};
  int size_ = 0;
};
template <class T>
List<T>::List(int size) : size_(size) {}
template <>
struct List<void> {
  int none;
};

namespace internal {
struct Hidden {
  int value;
};
}  // namespace internal

/// What can be counted.
template <class T>
concept Countable = requires(const T& t) { t.size(); };

/// Poses in a row.
using Poses = List<Pose>;
""", "#include <compare>\n"),
    "graph/internal/tree.h": "namespace placegraph {\nstruct Tree {\n  int size;\n};\n}\n",
    "io/file.h": header("/// Reads a pose from a file.\nPose read(const char* path);",
                        "#include <placegraph/graph/pose.h>\n"),
    "apps/help.h": "namespace placegraph::apps {\nvoid help();\n}\n",
}
SENTENCE = "/// " + "x" * 89 + ".\n"
# What is planted: the content of io/file.h, what the lint must say of it.
PLANTED = [
    ("struct Gap {};", "io/file.h:4: Gap: no docstring"),
    ("enum class Gap { kOne };", "io/file.h:4: Gap: no docstring"),
    ("template <class T>\nclass Gap {};", "io/file.h:5: Gap: no docstring"),
    ("template <class T>\nconcept Gap = true;", "io/file.h:5: Gap: no docstring"),
    ("using Gap = int;", "io/file.h:4: Gap: no docstring"),
    ("constexpr int kGap = 1;", "io/file.h:4: kGap: no docstring"),
    ("int gap();", "io/file.h:4: gap: no docstring"),
    ("// No docstring.\nint gap();", "io/file.h:5: gap: no docstring"),
    ("int gap();  ///< No docstring.", "io/file.h:4: gap: no docstring"),
    ("/// One.\nint one();\nint gap();", "io/file.h:6: gap: no docstring"),
    ("/// A.\nstruct A {\n  int gap;\n};", "io/file.h:6: A::gap: no docstring"),
    ("/// A.\nstruct A {\n  int one;  ///< of them\n  int gap;\n};", "io/file.h:7: A::gap: no docstring"),
    ("/// A.\nstruct A {\n  static constexpr int kGap = 1;\n};", "io/file.h:6: A::kGap: no docstring"),
    ("/// A.\nstruct A {\n  A();\n};", "io/file.h:6: A::A: no docstring"),
    ("/// A.\nstruct A {\n  int gap() const;\n};", "io/file.h:6: A::gap: no docstring"),
    ("/// A.\nstruct A {\n  template <class T>\n  T gap();\n};", "io/file.h:7: A::gap: no docstring"),
    ("/// A.\nstruct A {\n  explicit operator bool() const;\n};",
     "io/file.h:6: A::operator bool: no docstring"),
    ("/// A.\nstruct A {\n  int& operator[](int);\n};", "io/file.h:6: A::operator[]: no docstring"),
    ("/// A.\nclass A {\n public:\n  friend void gap(A) {}\n};", "io/file.h:7: gap: no docstring"),
    ("/// A.\nstruct A {\n  struct Gap {};\n};", "io/file.h:6: A::Gap: no docstring"),
    ("/// A.\nstruct A {\n  using Gap = int;\n};", "io/file.h:6: A::Gap: no docstring"),
    ("/** Text. */\nint gap();", "io/file.h:5: gap: its docstring does not stand above it behind ///"),
    ("/// Text without an end\nint gap();",
     "io/file.h:5: gap: the first line of its docstring does not end a sentence"),
    ("/// Text that goes on\n/// behind its line.\nint gap();",
     "io/file.h:6: gap: the first line of its docstring does not end a sentence"),
    ("/// Text that ends. And goes\n/// on.\nstruct Gap {};",
     "io/file.h:6: Gap: the first line of its docstring does not end a sentence"),
    (SENTENCE.replace("x", "xx", 1) + "int gap();",
     "io/file.h:5: gap: the first line of its docstring has 91 characters, 90 are allowed"),
]
PAIRS = [
    "/// A.\nstruct A {\n  int a, b;\n};",
    "/// A.\nstruct A {\n  int a;\n  int b;\n};",
]


def run(files, environment=None):
    with tempfile.TemporaryDirectory() as root:
        for file, content in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, file)), exist_ok=True)
            with open(os.path.join(root, file), "w", encoding="utf-8") as out:
                out.write(content)
        done = subprocess.run([sys.executable, LINT, root], capture_output=True, text=True, check=False,
                              env=os.environ | (environment or {}))
        return done.returncode, done.stdout + done.stderr


failures = []


def expect(name, got, code, lines, text):
    if got[0] != code or len(got[1].splitlines()) != lines or text not in got[1]:
        failures.append(f"{name}: expected {code} and '{text}', got {got[0]}: {got[1]}")


expect("the clean tree", run(CLEAN), 0, 1, "declarations of 2 headers, all documented")
expect("90 characters", run(CLEAN | {"io/file.h": header(SENTENCE + "int a();")}), 0, 1, "all documented")
for planted, expected in PLANTED:
    expect(planted, run(CLEAN | {"io/file.h": header(planted)}), 1, 1, expected)
for planted in PAIRS:
    expect(planted, run(CLEAN | {"io/file.h": header(planted)}), 1, 2, "A::b: no docstring")
expect("a broken header", run(CLEAN | {"io/file.h": header("int gap(;")}), 2, 1,
       "io/file.h:4: does not parse")
expect("no headers", run({"apps/help.h": CLEAN["apps/help.h"]}), 2, 1, "no public headers")
with tempfile.TemporaryDirectory() as hiding:
    os.mkdir(os.path.join(hiding, "clang"))
    with open(os.path.join(hiding, "clang", "__init__.py"), "w", encoding="utf-8") as broken:
        broken.write("raise ImportError\n")
    expect("no bindings", run(CLEAN, {"PYTHONPATH": hiding}), 2, 1, "install python3-clang-16")
print("\n".join(failures)
      or f"docstrings.py: a clean tree passes, {len(PLANTED) + len(PAIRS) + 3} planted faults are found")
sys.exit(1 if failures else 0)
