"""Judges what kenzan prints of all small notes by the schemas of those who read it: validate.py KENZAN WORK"""
import json
import pathlib
import subprocess
import sys

import jsonschema
import xmlschema

KENZAN, WORK = sys.argv[1], pathlib.Path(sys.argv[2])
TESTS = pathlib.Path(__file__).resolve().parent.parent
NOTES = sorted(p for d in ("examples", "course", "bad") for p in (TESTS / d).iterdir() if p.suffix in (".md", ".tex", ".qmd"))


def validator(path):
    schema = json.loads(path.read_text())
    kind = jsonschema.validators.validator_for(schema)
    return kind(schema, format_checker=kind.FORMAT_CHECKER)


SARIF = validator(WORK / "node_modules/@microsoft/sarif-multitool-linux/sarif-2.1.0.json")
REPORT = validator(TESTS.parent / "schema/report.schema.json")
JUNIT = [xmlschema.XMLSchema(str(p)) for p in sorted((WORK / "xsd").rglob("junit-10.xsd"))]


def faults(form, text):
    """What is wrong with a text of this form, in words."""
    if form == "junit":
        path = WORK / "printed.xml"
        path.write_text(text, encoding="utf-8")
        return [e.reason for schema in JUNIT for e in schema.iter_errors(str(path))]
    schema = SARIF if form == "sarif" else REPORT
    return [f"{list(e.absolute_path)}: {e.message[:200]}" for e in schema.iter_errors(json.loads(text))]


def main():
    assert JUNIT, "no schema of JUnit's files"
    passed = failed = 0
    for form in ("sarif", "junit", "json"):
        for path in NOTES:
            command = [KENZAN, "verify", str(path.relative_to(TESTS)), "--format", form, "--out", str(WORK / "out")]
            run = subprocess.run(command, cwd=TESTS, capture_output=True, text=True)
            if run.returncode == 2:  # no notes, or not readable: nothing is printed
                assert run.stdout == "", path
                continue
            found = faults(form, run.stdout)
            failed += bool(found)
            passed += not found
            for fault in found:
                print(f"{form} of {path.name}: {fault}")
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0 or passed < 100)


main()
