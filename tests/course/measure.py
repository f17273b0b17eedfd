#!/usr/bin/env python3
"""How many hidden misprints does Kenzan find? measure.py --kenzan target/release/kenzan --seeds 1-10

For each document and seed five misprints are hidden (`hide_errors.py`), and the notes are verified twice: as they are, and with
the annotations of the sidecar. Each hidden misprint is then

    edit    found, and the formula that is proposed in its place says what the formula said before
    here    found at its equation: it fails, or is suspect
    near    told by another equation of the same derivation, which fails or is suspect (`by` in detectable.toml)
    missed  by none of these
    holds   missed, and what is worse, the misprinted formula is said to hold

and each equation without a misprint that fails or is suspect is a false alarm, unless it is of the derivation of a misprint, or
rests on one by the premises that the report names (then it is counted as a consequence). Before that the documents are verified without misprints: what fails or is
suspect there is a false alarm, too. Standard library only.
"""
import argparse
import collections
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import tomllib

import formal
import hide_errors

HERE = pathlib.Path(__file__).resolve().parent
DOCUMENTS = ["electromagnetism.md", "relativity.tex", "linear-algebra.qmd"]
SUGGEST = False  # whether corrections are searched for in the runs with annotations
FOUND = ["edit", "here", "near", "missed", "holds"]


def verify(kenzan, notes, out, options):
    """The equations of the report in the order of the notes, and the seconds it took."""
    begun = time.perf_counter()
    done = subprocess.run([kenzan, "verify", str(notes), "--out", str(out), *options], capture_output=True, text=True, timeout=600)
    seconds = time.perf_counter() - begun
    path = out / "report.json"
    if done.returncode == 2 or not path.exists():
        return None, seconds, done.stderr.strip().splitlines()[:4]
    documents = json.loads(path.read_text())["documents"]
    equations = [e for d in documents for e in d["equations"]]
    return equations, seconds, []


def by_label(equations, labels):
    """The equations of the report for our labels: by label, by the label without its prefix, or else in their order."""
    found = {}
    for e in equations:
        found.setdefault(str(e.get("label", "")).lstrip("@#"), e)
        for other in e.get("labels", []):
            found.setdefault(str(other), e)
    if all(label in found for label in labels):
        return {label: found[label] for label in labels}
    numbered = [e for e in equations if e.get("numbered", True)]
    if len(numbered) == len(labels):
        return dict(zip(labels, numbered))
    return {label: found[label] for label in labels if label in found}


def alarm(equation):
    """Whether the report accuses this equation: it fails, or is suspect."""
    return equation is not None and (equation.get("verdict") == "fails" or bool(equation.get("suspect")))


def proposals(equation):
    """The formulas that the report proposes in place of the printed one."""
    suspect = equation.get("suspect") or []
    for one in suspect if isinstance(suspect, list) else [suspect]:
        if one.get("latex"):
            yield one["latex"]
    for one in equation.get("suggestions") or []:
        if one.get("latex"):
            yield one["latex"]


def macros(text, folder):
    """The \\newcommand definitions of the notes and of the files that they \\input."""
    for name in re.findall(r"\\input\{([^}]*)\}", text):
        text += (folder / (name + ".tex")).read_text()
    return re.findall(r"\\newcommand\{(\\[a-zA-Z]+)\}(?:\[(\d)\])?\{(.*)\}", text)


def expand(latex, definitions):
    """A formula with the notes' own commands written out, without labels."""
    latex = re.sub(r"\\label\{[^}]*\}", "", latex)
    for name, arguments, body in definitions:
        count = int(arguments or 0)
        pattern = re.escape(name) + r"(?![a-zA-Z])" + r"\{([^{}]*)\}" * count
        latex = re.sub(pattern, lambda m: re.sub(r"#(\d)", lambda a: m.group(int(a.group(1))), body) + " ", latex)
    return latex.replace(r"\mathrm{d}", "d").replace(r"\dfrac", r"\frac").replace(r"\tfrac", r"\frac")


def says_the_same(before, proposed, definitions):
    """Whether a proposal restores what the formula said, in the formal reading."""
    before, proposed = expand(before, definitions), expand(proposed, definitions)
    try:
        return not formal.differs(before, proposed)
    except formal.Unread:
        pass
    # A proposal may concern one statement of several.
    try:
        seeds = range(4)
        whole = [[a / (b or 1) for a, b in formal.residuals(before, s)] for s in seeds]
        part = [[a / (b or 1) for a, b in formal.residuals(proposed, s)] for s in seeds]
    except (formal.Unread, ArithmeticError, ValueError, TypeError, IndexError):
        return False
    same = lambda i, j: all(abs(whole[s][i] - part[s][j]) < 1e-9 for s in seeds)
    return bool(part[0]) and all(any(same(i, j) for i in range(len(whole[0]))) for j in range(len(part[0])))


def derivation(table, label):
    """The labels of the equations that tell a misprint in this one, or that it tells of."""
    own = set(table[label].get("by", []))
    return (own | {other for other, entry in table.items() if label in entry.get("by", [])}) - {label, "self", "text"}


def premises(equation):
    """The labels of the equations that the report takes as premises of this one, for its verdict or for its suspicion."""
    if equation is None:
        return set()
    suspect = equation.get("suspect") or {}
    suspect = suspect if isinstance(suspect, dict) else {}
    named = [*equation.get("given", []), *(equation.get("inferred") or {}).get("given", []), *suspect.get("premises", [])]
    found = {str(label) for label in named}
    # A chain names the premises of its parts by label and number: "75.2" is of (75).
    return found | {re.sub(r"\.\d+$", "", label) for label in found} | set(re.findall(r"contradicts \(([^)]*)\)", equation.get("reason") or ""))


def rests_on(label, equations, wrong):
    """Whether an equation rests, by however many steps, on one that has a misprint."""
    reached, queue = set(), [label]
    while queue:
        for premise in premises(equations.get(queue.pop())) - reached:
            if premise in wrong:
                return True
            reached.add(premise)
            queue.append(premise)
    return False


def classify(misprint, equations, table, hidden, definitions):
    """How a hidden misprint was found."""
    label = misprint["label"]
    own = equations.get(label)
    if alarm(own):
        return "edit" if any(says_the_same(misprint["before"], p, definitions) for p in proposals(own)) else "here"
    near = derivation(table, label) - {h["label"] for h in hidden}
    if any(alarm(equations.get(other)) for other in near):
        return "near"
    return "holds" if own is not None and own.get("verdict") in ("holds", "asymptotic") else "missed"


def run(kenzan, name, seed, errors, mode, annotated, folder):
    """One document, one seed: counts, and what was hidden and how it was found."""
    source = HERE / name
    table = tomllib.loads((HERE / "detectable.toml").read_text())[source.stem]
    target = folder / f"{source.stem}-{seed}-{mode}-{'with' if annotated else 'without'}"
    if seed is None:
        target.mkdir(parents=True, exist_ok=True)
        notes, hidden = target / source.name, []
        shutil.copy(source, notes)
        for other in re.findall(r"\\input\{([^}]*)\}", source.read_text()):
            shutil.copy(HERE / (other + ".tex"), target)
    else:
        notes, hidden = hide_errors.hide(source, errors, seed, mode, target)
    sidecar = HERE / (source.stem + ".kenzan.toml")
    if annotated:
        shutil.copy(sidecar, target)
    listed, seconds, trouble = verify(kenzan, notes, target / "out", ["--suggest"] if annotated and SUGGEST else [])
    if listed is None:
        return {"document": name, "seed": seed, "annotated": annotated, "trouble": trouble, "seconds": seconds}
    equations = by_label(listed, list(table))
    definitions = macros(source.read_text(), HERE)
    for h in hidden:
        h["found"] = classify(h, equations, table, hidden, definitions)
        h["verdict"] = equations.get(h["label"], {}).get("verdict", "absent")
    wrong = {h["label"] for h in hidden}
    touched = set().union(*(derivation(table, label) for label in wrong)) if wrong else set()
    accused = [label for label, e in equations.items() if alarm(e) and label not in wrong]
    touched |= {label for label in accused if rests_on(label, equations, wrong)}
    verdicts = collections.Counter(e["verdict"] for e in equations.values())
    undecided = [l for l, e in equations.items() if e["verdict"] == "undecided" and not e.get("suspect")]
    return {
        "document": name, "seed": seed, "annotated": annotated, "hidden": hidden, "seconds": seconds, "equations": len(equations),
        "verdicts": dict(sorted(verdicts.items())), "undecided": len(undecided),
        "false_alarms": [label for label in accused if label not in touched],
        "consequences": [label for label in accused if label in touched],
    }


def summary(runs):
    """One line for several runs of a document, with or without annotations."""
    found = collections.Counter(h["found"] for r in runs for h in r["hidden"])
    total = sum(found.values())
    cells = [f"{found[k]:4}" for k in FOUND]
    share = f"{100 * (total - found['missed'] - found['holds']) / total:4.0f} %" if total else "   – "
    false = sum(len(r["false_alarms"]) for r in runs)
    consequences = sum(len(r["consequences"]) for r in runs)
    undecided = sum(r["undecided"] for r in runs) / len(runs)
    seconds = sum(r["seconds"] for r in runs) / len(runs)
    return f"{total:6} {' '.join(cells)}  {share} {false:6} {consequences:6} {undecided:9.1f} {seconds:8.2f}"


def table_of(title, runs):
    print(f"\n{title}")
    print(f"{'document':24} {'annotations':12} hidden edit here near miss hold  found  false   cons undecided  seconds")
    for name in dict.fromkeys(r["document"] for r in runs):
        for annotated in (False, True):
            some = [r for r in runs if r["document"] == name and r["annotated"] == annotated]
            good = [r for r in some if "trouble" not in r]
            if some and not good:
                print(f"{name:24} {'with' if annotated else 'without':12} not read: {' '.join(some[0]['trouble'])[:80]}")
            elif good:
                print(f"{name:24} {'with' if annotated else 'without':12} {summary(good)}")
    for annotated in (False, True):
        good = [r for r in runs if r["annotated"] == annotated and "trouble" not in r]
        if good:
            print(f"{'all':24} {'with' if annotated else 'without':12} {summary(good)}")


def seeds_of(text):
    first, _, last = text.partition("-")
    return range(int(first), int(last or first) + 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kenzan", default="target/release/kenzan")
    parser.add_argument("--seeds", type=seeds_of, default=seeds_of("1"))
    parser.add_argument("--errors", type=int, default=5)
    parser.add_argument("--documents", nargs="*", default=DOCUMENTS)
    parser.add_argument("--undetectable", action="store_true", help="also hide what no reader can know, and count it apart")
    parser.add_argument("--verbose", action="store_true", help="list every misprint and how it was found")
    parser.add_argument("--keep", help="keep the notes and reports in this folder")
    parser.add_argument("--json", help="write the runs to this file")
    parser.add_argument("--suggest", action="store_true", help="search for corrections in the runs with annotations")
    a = parser.parse_args()
    globals()["SUGGEST"] = a.suggest
    kenzan = shutil.which(a.kenzan) or str(pathlib.Path(a.kenzan).resolve())
    everything = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(a.keep or scratch)
        both = (False, True)
        clean = [run(kenzan, d, None, 0, "clean", w, folder) for d in a.documents for w in both]
        table_of("without misprints", clean)
        for r in clean:
            if r.get("false_alarms"):
                print(f"  false alarms in {r['document']} {'with' if r['annotated'] else 'without'} annotations: {', '.join(r['false_alarms'])}")
            if "verdicts" in r:
                print(f"  {r['document']} {'with' if r['annotated'] else 'without'}: " + ", ".join(f"{n} {v}" for v, n in r["verdicts"].items()))
        everything["clean"] = clean
        for mode in ["detectable", "undetectable"] if a.undetectable else ["detectable"]:
            runs = [run(kenzan, d, s, a.errors, mode, w, folder) for d in a.documents for s in a.seeds for w in both]
            table_of(f"{a.errors} misprints each, {mode}, seeds {a.seeds[0]} to {a.seeds[-1]}", runs)
            everything[mode] = runs
            if a.verbose:
                listing(runs)
    if a.json:
        pathlib.Path(a.json).write_text(json.dumps(everything, indent=1, ensure_ascii=False) + "\n")


def listing(runs):
    for r in runs:
        if "trouble" in r:
            continue
        print(f"\n{r['document']} seed {r['seed']} {'with' if r['annotated'] else 'without'} annotations; false alarms: {', '.join(r['false_alarms']) or 'none'}")
        for h in r["hidden"]:
            print(f"  {h['found']:6} ({h['label']}, {h['verdict']}) {h['kind']}: {' '.join(h['after'].split())[:110]}")


if __name__ == "__main__":
    main()
