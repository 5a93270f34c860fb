#!/usr/bin/python3
"""summary.py BUILD GROUP...: counts the tests that the ctests of these groups ran.

Every ctest that is a test program writes BUILD/test_results/NAME.xml; the others (lint, examples)
count as one test each, passed if scripts/test has noted them in BUILD/passed.GROUP. Names the skipped
ones with their reasons. Exits 1 where a test failed, a program left no results or nothing was run. The
line `tests: N passed, M skipped, K failed` is for other scripts.
"""

import collections
import json
import pathlib
import subprocess
import sys
import xml.etree.ElementTree


def ctests(build, group):
    """Names of the ctests of a group, and whether each writes results of its own."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", "-L", f"^{group}$"],
                            capture_output=True, text=True, check=True)
    for test in json.loads(listed.stdout)["tests"]:
        environment = [value for p in test.get("properties", []) if p["name"] == "ENVIRONMENT"
                       for value in p["value"]]
        yield test["name"], any(value.startswith("GTEST_OUTPUT=") for value in environment)


def count(path, skipped):
    """Passed and failed tests of one file of results; adds the skipped ones by reason."""
    passed, failed = 0, []
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        name = f'{case.get("classname")}.{case.get("name")}'
        skip = case.find("skipped")
        if case.get("status") == "notrun":
            continue
        if case.find("failure") is not None:
            failed.append(name)
        elif skip is not None:
            reason = (skip.get("message") or skip.text or "").strip().splitlines()
            skipped[reason[-1] if reason else "no reason given"].append(name)
        else:
            passed += 1
    return passed, failed


def main():
    build, groups = sys.argv[1], sys.argv[2:]
    passed, failed, missing, skipped = 0, [], [], collections.defaultdict(list)
    for group in groups:
        noted = set(pathlib.Path(build, f"passed.{group}").read_text().split())
        for name, writes_results in ctests(build, group):
            if not writes_results:
                if name in noted:
                    passed += 1
                else:
                    failed.append(name)
                continue
            path = pathlib.Path(build, "test_results", name + ".xml")
            if not path.exists():
                missing.append(name)
                continue
            here, broken = count(path, skipped)
            passed += here
            failed += broken
    for reason, names in sorted(skipped.items()):
        print(f"skipped ({reason}): " + " ".join(sorted(names)))
    for name in failed:
        print(f"failed: {name}")
    for name in missing:
        print(f"no results: {name} did not come to its end")
    print(f"tests: {passed} passed, {sum(map(len, skipped.values()))} skipped, {len(failed) + len(missing)} failed")
    return 1 if failed or missing or not (passed or skipped) else 0


sys.exit(main())
