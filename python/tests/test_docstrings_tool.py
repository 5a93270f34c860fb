"""python/tools/docstrings.py: names, comments and the words of Python, from headers as strings."""

import importlib
import pathlib
import sys
from types import ModuleType

import pytest

TOOLS = pathlib.Path(__file__).resolve().parents[1] / "tools"


def tool(name: str) -> ModuleType:
    sys.path.insert(0, str(TOOLS))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(TOOLS))


def texts(*headers: str) -> dict[str, str]:
    found: dict[str, str] = tool("docstrings").docstrings_of(
        [header.splitlines() for header in headers])
    return found


CAMERA = """
#pragma once
namespace [[gnu::visibility("default")]] placegraph {

/// A camera.
///
/// It has no distortion.
class Camera : public Base {
 public:
  /// Projects a point.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p) const;
  /// Projects many points.
  void project(const std::vector<Eigen::Vector3d>& points) const;
  int size() const { return size_; }
  double fx = 0, fy = 0;  ///< [px]
  std::string name = "a; b {";  ///< its name,
                                ///< in one line
 private:
  int size_;
};

enum class Mode {
  kFast,  ///< as fast as possible
  kSlow,
};

/// Doubles a number.
template <class T>
T doubled(T value);
}  // namespace placegraph
"""


def test_names_and_comments() -> None:
    assert texts(CAMERA) == {
        "Camera": "A camera.\n\nIt has no distortion.",
        "Camera::project": "Projects a point.",  # the first of two overloads
        "Camera::fx": "[px]", "Camera::fy": "[px]",
        "Camera::name": "its name,\nin one line",
        "kFast": "as fast as possible",
        "doubled": "Doubles a number.",
    }


def test_a_name_with_two_meanings_is_left_out() -> None:
    first = "/// Cost of a graph.\ndouble chi2(const Graph& graph);\n/// Other.\nint other();"
    second = "/// Cost of a track.\ndouble chi2(const Track& track);"
    assert texts(first, second) == {"other": "Other."}
    assert texts(first, first) == texts(first)
    assert texts(first, "double chi2(int);") == texts(first)  # no comment, no other meaning


MODES = "enum class State { kTooFewData, kLost };\nenum class TrackingState { kTracking, kLost };\n"


@pytest.mark.parametrize("comment, expected", [
    ("Throws ArgumentError", "Raises ArgumentError"),
    ("it throws; what is thrown", "it raises; what is raised"),
    ("run_sequence, optimize_pose_graph, run_sequences", "run, optimize, run_sequences"),
    ("as Slam::notes and Map::~Map", "as Slam.notes and Map.~Map"),
    ("std::nullopt or nullptr, a std::string, a std::vector", "None or None, a str, a vector"),
    ("a CV_8UC1, CV_8UC3 and CV_32FC1", "a H x W uint8, H x W x 3 uint8 (BGR) and H x W float32"),
    ("CV_32FC2, CV_16UC1, CV_64F", "H x W x 2 float32, H x W uint16, H x W float64"),
    ("`kTracking` if posed", "`TrackingState.TRACKING` if posed"),
    ("kTooFewData: no points", '"too few data": no points'),
    ("kLost is of two", "kLost is of two"),  # nobody knows which: the bindings need a text
    ("TrackingState::kLost, State::kLost", 'TrackingState.LOST, "lost"'),
    ("the kRanks best", "the kRanks best"),  # a constant
    ("true: it is; `false`", "True: it is; False"),
    ("a true match if `placed` is false", "a true match if `placed` is False"),
    ("nothing if there is none", "nothing if there is none"),
])
def test_words_of_python(comment: str, expected: str) -> None:
    assert texts(f"{MODES}/// {comment}\nint value();")["value"] == expected


@pytest.mark.parametrize("declaration", [
    "std::optional<SE3> value;", "std::optional<SE3> value() const;",
    "std::array<std::optional<double>, 3> value = {};",
])
@pytest.mark.parametrize("comment, expected", [
    ("The pose; nothing if it is unknown.", "The pose; None if it is unknown."),
    ("The pose. Nothing outside the recording.", "The pose. None outside the recording."),
    ("|t| = 1; none for a rotation", "|t| = 1; None for a rotation"),
    ("0: nothing was removed", "0: nothing was removed"),
])
def test_an_optional_value_is_none(declaration: str, comment: str, expected: str) -> None:
    assert texts(f"/// {comment}\n{declaration}")["value"] == expected
    behind = texts(f"struct A {{\n  {declaration}  ///< {comment}\n}};")
    assert behind["A::value"] == expected


def test_an_optional_parameter_is_no_optional_value() -> None:
    header = "/// Nothing if empty.\nbool value(const std::optional<int>& number);"
    assert texts(header)["value"] == "Nothing if empty."


def test_enums_are_those_of_the_bindings() -> None:
    sources = "".join(path.read_text() for path in (TOOLS.parent / "src").rglob("*.cpp"))
    bound = {part.split(">", 1)[0] for part in sources.split("nb::enum_<")[1:]}
    assert tool("python_terms").PYTHON_ENUMS == bound


def test_the_header_that_is_written(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    header, out = tmp_path / "camera.h", tmp_path / "docstrings.h"
    header.write_text('/// Says "a\\b".\n/// Throws nothing.\nvoid say();\n/// First.\nint a();\n')
    monkeypatch.setattr(sys, "argv", ["docstrings.py", str(out), str(header)])
    tool("docstrings").main()
    rows = [line.strip() for line in out.read_text().splitlines() if line.startswith("    {")]
    assert rows == ['{"a", "First."},', r'{"say", "Says \"a\\b\".\nRaises nothing."},']
