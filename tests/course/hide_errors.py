#!/usr/bin/env python3
"""Hides misprints in lecture notes: hide_errors.py NOTES --errors 5 --seed 1 --out DIR

Writes the notes with the misprints and, beside them, NAME.hidden.json: for each misprint its equation, its kind and the
formula before and after. The misprints are changes of the LaTeX text such as happen in print: a sign, a factor, an exponent,
an index, sin for cos, a fraction upside down, a neighbouring symbol, a term or a root lost. Each is in another equation, and none
leaves what the formula says (`formal.py`).

Which misprints a reader can know to be wrong from the rest of the notes was decided by hand, equation by equation, in
`detectable.toml`, before any of the notes were run through Kenzan. By default only those are hidden; `--mode undetectable` hides
the others, to see that they raise no false alarm elsewhere. Standard library only; nothing of Kenzan is used.
"""
import argparse
import json
import pathlib
import random
import re
import shutil
import tomllib

import formal

HERE = pathlib.Path(__file__).resolve().parent
GREEK = set("""alpha beta gamma delta varepsilon epsilon eta theta lambda mu sigma tau phi varphi omega Phi Delta
    bet gam""".split())
TRIG = {r"\sin": r"\cos", r"\cos": r"\sin", r"\sinh": r"\cosh", r"\cosh": r"\sinh"}
FRACTIONS = (r"\frac", r"\tfrac", r"\dfrac")
NEEDS_RIGHT = (r"\partial", "d", r"\dd", r"\Delta", r"\cdot", r"\times", "^", "/")  # something must follow these
OPENS = ("", "+", "-", "=", "{", "(", "[", "|", "&", ",", "}", r"\left", r"\\", r"\qquad")
ENDS = ("", "+", "-", "=", "}", ")", "]", "|", "&", ",", ".", r"\right", r"\\", r"\end", r"\qquad", r"\approx", r"\nonumber")
CLOSED = {"{": "}", "(": ")", "[": "]"}


def displays(text, suffix):
    """The displayed equations of the notes: their label, and the span of their LaTeX without `$$` or environment."""
    if suffix == ".tex":
        found = []
        for m in re.finditer(r"\\begin\{(equation|align)\}(.*?)\\end\{\1\}", text, re.S):
            labels = re.findall(r"\\label\{([^}]*)\}", m.group(2))
            found.append({"label": labels[0], "start": m.start(2), "end": m.end(2)})
        return found
    found = []
    for m in re.finditer(r"\$\$(.*?)\$\$[ ]*(\{#([^}]*)\})?", text, re.S):
        tag = re.search(r"\\tag\{([^}]*)\}", m.group(1))
        end = m.start(1) + tag.start() if tag else m.end(1)
        label = tag.group(1) if tag else m.group(3)
        found.append({"label": label, "start": m.start(1), "end": end})
    return found


class Formula:
    """The tokens of one formula, with what encloses each and with its symbols."""

    def __init__(self, latex):
        self.latex = latex
        self.tokens = formal.tokens(latex)
        self.owner = []  # for each token: the commands or brackets around it, outermost first
        stack = []
        for i, token in enumerate(self.tokens):
            if token in CLOSED.values() and stack:
                stack.pop()
            self.owner.append(tuple(stack))
            if token in CLOSED:
                stack.append(self.owner_of(i) if token == "{" else token)
        self.atoms = list(self.find_atoms())

    def owner_of(self, i):
        """The command that a brace belongs to; the second brace of a fraction belongs to it, too."""
        j = self.before(i)
        if j is not None and self.tokens[j] == "}":
            depth = 0
            while j >= 0:
                depth += {"}": 1, "{": -1}.get(self.tokens[j], 0)
                if depth == 0:
                    return self.owner_of(j)
                j -= 1
        return self.tokens[j] if j is not None else "{"

    def before(self, i):
        i -= 1
        while i >= 0 and self.tokens[i].isspace():
            i -= 1
        return i if i >= 0 else None

    def after(self, i):
        i += 1
        while i < len(self.tokens) and self.tokens[i].isspace():
            i += 1
        return i if i < len(self.tokens) else None

    def token(self, i):
        return "" if i is None else self.tokens[i]

    def in_names(self, i):
        """Inside a subscript, a name or a label, where nothing is changed but the index as a whole."""
        return any(o in ("_", r"\label", r"\begin", r"\end", r"\operatorname", r"\mathrm", r"\mathbf", r"\vc", r"\hat", r"\bar", r"\der") for o in self.owner[i])

    def close(self, i):
        """The index of the bracket that closes the one at i."""
        opening, closing, depth = self.tokens[i], CLOSED[self.tokens[i]], 0
        for j in range(i, len(self.tokens)):
            depth += (self.tokens[j] == opening) - (self.tokens[j] == closing)
            if depth == 0:
                return j
        raise formal.Unread("a bracket is not closed")

    def find_atoms(self):
        """The symbols: (start, end, base, index, primes) with the tokens start..end."""
        i = 0
        while i < len(self.tokens):
            token, start = self.tokens[i], i
            decorated = token in (r"\mathbf", r"\vc", r"\bar", r"\hat") and self.token(i + 1) == "{"
            letter = re.fullmatch(r"[a-zA-Z]", token) or (token.startswith("\\") and token[1:] in GREEK)
            if not (decorated or letter) or self.in_names(i) or self.token(self.before(i)) == "_":
                i += 1
                continue
            i = self.close(i + 1) + 1 if decorated else i + 1
            base = "".join(self.tokens[start:i])
            index = primes = ""
            while self.token(i) in ("_", "'"):
                if self.tokens[i] == "'":
                    primes, i = primes + "'", i + 1
                else:
                    end = self.close(i + 1) + 1 if self.token(i + 1) == "{" else i + 2
                    index, i = "".join(self.tokens[i:end]), end
            if base == "e" and self.token(i) == "^" or self.is_differential(start, base):
                continue
            yield start, i, base, index, primes

    def is_differential(self, i, base):
        """The d of dt or of d/dt, or what is differentiated or summed: left alone when things are dropped."""
        follows = self.token(self.after(i))
        starts = self.token(self.before(i)) in (r"\,", "{", "")
        return base == "d" and starts and (follows in ("t", "q", "r", "Q", "I", "^", "k", "\\omega", "\\Phi", "\\mathbf"))

    def replaced(self, start, end, by):
        return "".join(self.tokens[:start]) + by + "".join(self.tokens[end:])


def glue(left, right):
    """Two pieces of LaTeX, with a space between where a command would swallow a letter."""
    return left + (" " if re.search(r"\\[a-zA-Z]+$", left) and right[:1].isalpha() else "") + right


def put(f, start, end, by):
    return glue(glue("".join(f.tokens[:start]), by), "".join(f.tokens[end:]))


def signs(f):
    for i, token in enumerate(f.tokens):
        if f.in_names(i):
            continue
        before = f.token(f.before(i))
        if token in "+-" and before not in ("", "=", "{", "(", "&", r"\left", r"\\", ",", r"\qquad", "["):
            yield "sign", put(f, i, i + 1, "-" if token == "+" else "+"), None
        elif token == "-":
            yield "sign", put(f, i, f.after(i), ""), None
        elif token == "=" and f.token(f.after(i)) != "-" and f.after(i) is not None and f.token(f.after(i)) != "0":
            yield "sign", put(f, i, i + 1, "= -"), None


def factors(f):
    """A factor of two, three or four lost; a factor of two gained."""
    for i, token in enumerate(f.tokens):
        if f.in_names(i) or "^" in f.owner[i]:
            continue
        before, follows = f.token(f.before(i)), f.token(f.after(i))
        if token in ("2", "3", "4") and before not in ("^", "_") and follows not in ("}", ")", ""):
            yield "factor lost", put(f, i, f.after(i), ""), None
        if token in (r"\frac", r"\tfrac") and "".join(f.tokens[i + 1 : i + 4]) == "{1}":
            end = f.close(f.after(i + 3)) + 1
            if "".join(f.tokens[i + 4 : end]) in ("{2}", "{4}") and f.token(f.after(end - 1)):
                yield "factor lost", put(f, i, end, ""), None
        if token == r"\half":
            yield "factor lost", put(f, i, i + 1, ""), None
    for start, _, base, index, primes in f.atoms:
        before = f.token(f.before(start))
        if before in ("+", "-", "=", "{") and "^" not in f.owner[start] and not f.in_names(start):
            if f.owner[start][-1:] not in ((r"\begin",),) and before != "^":
                yield "factor gained", put(f, start, start, "2 "), base + index + primes


def exponents(f):
    for i, token in enumerate(f.tokens):
        if token == "^" and f.token(i + 1) in ("2", "3", "4") and not f.in_names(i):
            if f.token(f.before(i)) == "d":  # the order of a derivative
                continue
            power = f.tokens[i + 1]
            yield "exponent", put(f, i, i + 2, ""), None
            yield "exponent", put(f, i + 1, i + 2, {"2": "3", "3": "2", "4": "2"}[power]), None


def trigs(f):
    for i, token in enumerate(f.tokens):
        if token in TRIG:
            yield "sin and cos", put(f, i, i + 1, TRIG[token]), None


def fractions(f):
    for i, token in enumerate(f.tokens):
        if token not in FRACTIONS or f.token(i + 1) != "{":
            continue
        middle = f.close(i + 1)
        if f.token(middle + 1) != "{":
            continue
        end = f.close(middle + 1)
        top, bottom = "".join(f.tokens[i + 2 : middle]), "".join(f.tokens[middle + 2 : end])
        derivative = r"\partial" in top or r"\partial" in bottom or re.match(r"d(\^2)?( |\\|[A-Z]|t$)", bottom) or bottom == "dt"
        if not derivative and top != "1" and bottom not in ("1", "2", "4", "8"):
            yield "upside down", put(f, i + 1, end + 1, "{" + bottom + "}{" + top + "}"), None


def indices(f, atoms):
    """Another index of the same letter, or a prime lost."""
    for start, end, base, index, primes in f.atoms:
        name = base + index + primes
        for other in sorted(atoms):
            if other[0] == base and other[1] != index and other[2] == primes:
                yield "index", put(f, start, end, "".join(other)), name
        if primes:
            yield "prime lost", put(f, start, end, base + index), name


def is_vector(base):
    return r"\mathbf" in base or base.startswith(r"\vc")


def neighbours(f, atoms):
    """A symbol replaced by another one that occurs near by."""
    for start, end, base, index, primes in f.atoms:
        vector = is_vector(base)
        for other in sorted(atoms):
            if other[0] != base and is_vector(other[0]) == vector:
                yield "symbol", put(f, start, end, "".join(other)), base + index + primes


def lost_symbols(f):
    """A symbol lost from a product."""
    for start, end, base, index, primes in f.atoms:
        before, follows = f.token(f.before(start)), f.token(f.after(end - 1))
        if before in NEEDS_RIGHT or before in formal.FUNCTIONS or follows in (r"\cdot", r"\times", "^"):
            continue
        if before in OPENS and follows in ENDS:  # it stands alone: nothing would be left
            continue
        yield "symbol lost", put(f, start, end, ""), base + index + primes


def terms(f):
    """A term lost from a sum."""
    for i, token in enumerate(f.tokens):
        if token not in "+-" or f.in_names(i) or f.token(f.before(i)) in ("", "=", "{", "(", "&", r"\left"):
            continue
        j, depth = i + 1, 0
        while j < len(f.tokens):
            t = f.tokens[j]
            if depth == 0 and (t in "+-=,&)]}" or t in (r"\\", r"\right", r"\end", r"\qquad", r"\label", r"\nonumber") or t in formal.RELATIONS):
                break
            depth += (t in CLOSED) - (t in CLOSED.values())
            j += 1
        yield "term lost", put(f, i, j, ""), None


def roots(f):
    for i, token in enumerate(f.tokens):
        if token == r"\sqrt" and f.token(i + 1) == "{":
            end = f.close(i + 1)
            inside = "".join(f.tokens[i + 2 : end])
            yield "root lost", put(f, i, end + 1, r"\left( " + inside.strip() + r" \right)"), None


def misprints(latex, atoms):
    """All misprints of a formula that change what it says: (kind, formula, the symbol concerned or None)."""
    f = Formula(latex)
    every = [*signs(f), *factors(f), *exponents(f), *trigs(f), *fractions(f), *indices(f, atoms), *neighbours(f, atoms), *lost_symbols(f), *terms(f), *roots(f)]
    found, seen = [], set()
    for kind, after, symbol in every:
        if after in seen:
            continue
        seen.add(after)
        try:
            if formal.differs(latex, after):
                found.append((kind, after, symbol))
        except formal.Unread:
            continue  # a misprint that no reader could parse is not of the kind that is hidden here
    return found


def nearby(equations, text, at):
    """The symbols of this equation and of the two on either side."""
    atoms = set()
    for e in equations[max(0, at - 2) : at + 3]:
        atoms |= {(base, index, primes) for _, _, base, index, primes in Formula(text[e["start"] : e["end"]]).atoms}
    return atoms


def is_detectable(entry, kind, after, symbol):
    """The judgement made by hand: would a reader know, from the rest of these notes, that this is wrong?"""
    after = " ".join(re.sub(r"\\label\{[^}]*\}", "", after).split())
    arbitrary = any(re.search(e, after) for e in entry.get("not_after", []))
    named = symbol in entry.get("not_symbols", []) and kind in ("symbol", "index", "prime lost", "symbol lost")
    return entry["detectable"] and kind not in entry.get("not_kinds", []) and not named and not arbitrary


def choose(text, suffix, table, errors, seed, mode):
    """Misprints for some of the equations, at most one for each; kinds are as likely as each other."""
    rng = random.Random(seed)
    equations = displays(text, suffix)
    order = list(range(len(equations)))
    rng.shuffle(order)
    hidden = []
    for at in order:
        if len(hidden) == errors:
            break
        e = equations[at]
        latex = text[e["start"] : e["end"]]
        wanted = mode == "detectable"
        fit = [m for m in misprints(latex, nearby(equations, text, at)) if is_detectable(table[e["label"]], *m) == wanted]
        if fit:
            kind = rng.choice(sorted({m[0] for m in fit}))
            _, after, symbol = rng.choice([m for m in fit if m[0] == kind])
            hidden.append({"label": e["label"], "kind": kind, "symbol": symbol, "before": latex.strip(), "after": after.strip(), "raw": after, **e})
    return sorted(hidden, key=lambda m: m["start"])


def apply(text, hidden):
    """The notes with the misprints; from the end, so that the spans stay true."""
    for m in reversed(hidden):
        text = text[: m["start"]] + m["raw"] + text[m["end"] :]
    return text


def hide(notes, errors, seed, mode, out):
    """Writes the notes with misprints and the list of them; gives the path of the notes and the list."""
    notes, out = pathlib.Path(notes), pathlib.Path(out)
    table = tomllib.loads((HERE / "detectable.toml").read_text())[notes.stem]
    text = notes.read_text()
    hidden = choose(text, notes.suffix, table, errors, seed, mode)
    out.mkdir(parents=True, exist_ok=True)
    target = out / notes.name
    target.write_text(apply(text, hidden))
    for name in re.findall(r"\\input\{([^}]*)\}", text):
        shutil.copy(notes.parent / (name + ".tex"), out)
    listed = [{k: m[k] for k in ("label", "kind", "symbol", "before", "after")} for m in hidden]
    (out / (notes.stem + ".hidden.json")).write_text(json.dumps({"notes": notes.name, "seed": seed, "mode": mode, "hidden": listed}, indent=1, ensure_ascii=False) + "\n")
    return target, listed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("notes")
    parser.add_argument("--errors", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mode", choices=["detectable", "undetectable"], default="detectable")
    parser.add_argument("--out", default="hidden")
    a = parser.parse_args()
    target, listed = hide(a.notes, a.errors, a.seed, a.mode, a.out)
    print(target)
    for m in listed:
        print(f"  ({m['label']}) {m['kind']}\n    - {' '.join(m['before'].split())}\n    + {' '.join(m['after'].split())}")


if __name__ == "__main__":
    main()
