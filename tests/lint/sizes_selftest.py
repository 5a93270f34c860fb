"""sizes_selftest.py LINT: sizes.py passes a clean tree and catches what is planted."""
import os
import subprocess
import sys
import tempfile

LINT = sys.argv[1]
LINE = "  ++sum;\n"


def function(head, lines):
    """A function of that many lines, its head and its braces among them."""
    return head + " {\n" + LINE * (lines - 2) + "}\n"


# file: content; of the tree that has no fault
CLEAN = {
    "graph/chain.h": "#pragma once\nclass Chain {\n public:\n  void add(int link);\n  struct Link {\n"
                     "    int to = 0;\n  };\n};\n",
    # Another class of that name, in a namespace of its own.
    "io/chain.h": "#pragma once\nnamespace files {\nclass Chain {\n  int links;\n};\n}\n",
    "graph/core/time.h": "class Time {\n  void pass();\n};\n",
    "graph/core/time.cpp": "void Time::pass() {\n}\n",
    "graph/chain.cpp": '#include "graph/chain.h"\n' + function("void Chain::add(int link)", 60),
    # Braces in literals, comments and lambdas; initializers; a class of 150 lines; nested functions.
    "io/text.cpp": 'const char* kOpen = "{ (";  // {\nconst int kTable[] = {1, 2, 3};\n/* { */\n'
                   "enum class Kind { kOne, kTwo };\nnamespace {\n"
                   "class Inner {\n" + "  int a;\n" * 148 + "};\n"
                   "template <class T, int N = 2>\nstruct Tree {\n  Tree() : a{1}, b(2) {}\n"
                   "  int a, b;\n};\n}  // namespace\n"
                   "void outer() {\n  auto f = [](int x) {\n    return x;\n  };\n}\n"
                   "bool operator==(const Inner& a, const Inner& b) {\n  return true;\n}\n"
                   "const char* kRaw = R\"sql(create { table)sql\";\n",
    "io/digits.cpp": "const int kMany = 1'000;  // it's {\nint f() {\n  return kMany;\n}\n",
    # A class of the source's own is no slice, and neither is a nested class of its header.
    "pipeline/run.cpp": "struct Runner {\n  void go();\n};\nvoid Runner::go() {\n}\n",
    "pipeline/driver.h": "class Driver {\n  struct Part;\n};\nstruct Driver::Part {\n  void go();\n};\n",
    "pipeline/driver.cpp": "void Driver::Part::go() {\n}\n",
}
# What is planted: file, content, what the lint must say of it.
PLANTED = [
    ("graph/long.cpp", function("int long_one(int a,\n             int b)", 60),
     "graph/long.cpp:1: function long_one has 61 lines, 60 are allowed"),
    ("graph/member.h", "class Holder {\n" + function("  int inside() const", 61) + "};\n",
     "graph/member.h:2: function inside has 61 lines"),
    ("io/constructor.cpp", "struct A {\n  A();\n};\n" + function("A::A()\n    : a_(1),\n      b_{2}", 61),
     "io/constructor.cpp:4: function A has 63 lines"),
    ("backend/wide.h", "template <int D>\nclass Wide final : public Base<D> {\n" + "  int a;\n" * 148 + "};\n",
     "backend/wide.h:1: class Wide has 151 lines, 150 are allowed"),
    ("graph/behind.cpp", "void g() { const int k = 1'000; }  // it's {\n" + function("void h()", 61),
     "graph/behind.cpp:2: function h has 61 lines"),
    ("graph/sums.cpp", "struct S {\n  int a;\n};\n" + function("S& operator+=(S& s, int a)", 61),
     "graph/sums.cpp:4: function operator+= has 61 lines"),
    ("graph/call.h", "struct F {\n" + function("  int operator()(int a) const", 61) + "};\n",
     "graph/call.h:2: function operator() has 61 lines"),
    ("graph/shift.h", function("template <int N = 1 << 3>\nvoid shift()", 61),
     "graph/shift.h:1: function shift has 62 lines"),
    ("graph/lambda.cpp", function("const auto kRule = [](int a)", 61)[:-1] + ";\n",
     "graph/lambda.cpp:1: function kRule has 61 lines"),
    ("graph/unnamed.h", "struct {\n" + "  int a;\n" * 149 + "} all;\n",
     "graph/unnamed.h:1: class (unnamed) has 151 lines"),
    ("pipeline/chain.h", "#pragma once\nclass Chain {\n  int links;\n};\n",
     "pipeline/chain.h:2: class Chain is also in graph/chain.h"),
    ("graph/many.h", "// a line\n" * 401, "graph/many.h: 401 lines, 400 are allowed"),
    ("graph/open.cpp", "void f() {\n", "graph/open.cpp:1: a brace is not closed"),
    ("graph/closed.cpp", "void f() {\n}\n}\n", "graph/closed.cpp:3: a brace is closed"),
    ("graph/chain_views.h", '#include "graph/chain.h"\ninline void Chain::add(int link) {\n}\n',
     "graph/chain_views.h:2: defines members of Chain, which chain_views.h does not declare"),
    ("graph/chain_views.cpp", '#include "graph/chain.h"\nvoid Chain::add(int link) {\n}\n',
     "graph/chain_views.cpp:2: defines members of Chain, which chain_views.h does not declare"),
]


def write(root, file, content):
    path = os.path.join(root, file)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as out:
        out.write(content)


def run(root):
    done = subprocess.run([sys.executable, LINT, root], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


with tempfile.TemporaryDirectory() as root:
    for file, content in CLEAN.items():
        write(root, file, content)
    code, said = run(root)
    assert code == 0, f"the clean tree is refused:\n{said}"
    for file, content, wanted in PLANTED:
        write(root, file, content)
        code, said = run(root)
        assert code == 1 and wanted in said and said.count("\n") == 1, f"planted {file}, said:\n{said}"
        os.remove(os.path.join(root, file))
print(f"sizes.py: a clean tree passes, {len(PLANTED)} planted faults are found")
