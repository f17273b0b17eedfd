"""A formal reading of a displayed formula, good for one question: does a change of its LaTeX change what it says?

Every symbol gets a random value; operators (d, partial, the integral sign, the dot and the cross) count as factors, vectors and
matrices as numbers. The laws of algebra that a misprint could hide behind hold in this reading: sums and products commute,
a common constant factor of both sides drops out, functions are the true functions. So where the reading does not
change, the formula says the same; where it does, the misprint is one. Standard library only; nothing of Kenzan is used.
"""
import cmath
import math
import random
import re

TOKEN = re.compile(r"\\[a-zA-Z]+\*?|\\.|\d+(?:\.\d+)?|\s+|.", re.S)
RELATIONS = {"=", "<", ">", r"\approx", r"\le", r"\ge", r"\to", r"\equiv"}
SPACES = {r"\,", r"\;", r"\!", r"\quad", r"\qquad", r"\displaystyle", r"\nonumber", r"\notag", "~", r"\ "}
FUNCTIONS = {
    r"\sin": cmath.sin, r"\cos": cmath.cos, r"\tan": cmath.tan, r"\sinh": cmath.sinh, r"\cosh": cmath.cosh,
    r"\tanh": cmath.tanh, r"\exp": cmath.exp, r"\ln": cmath.log, r"\log": cmath.log, r"\artanh": cmath.atanh,
}
FRACTIONS = {r"\frac", r"\tfrac", r"\dfrac", r"\der"}
DECORATIONS = {r"\mathbf", r"\hat", r"\bar", r"\vc", r"\vec", r"\mathrm", r"\operatorname", r"\text", r"\dot", r"\ddot"}
BIG = {r"\int", r"\oint", r"\sum", r"\prod"}


class Unread(Exception):
    """The formula is not of the simple kind that this reading knows."""


def tokens(latex):
    """The tokens of a formula; their concatenation is the formula."""
    return TOKEN.findall(latex)


def statements(latex):
    """The formula, cut into statements, each a list of the sides of its chain, each a list of tokens."""
    latex = re.sub(r"\\label\{[^}]*\}|\\tag\{[^}]*\}|%[^\n]*", " ", latex)
    latex = re.sub(r"\\(begin|end)\{(aligned|align\*?|split|gathered)\}", " ", latex)
    rows, depth, environment = [[[]]], 0, 0
    for token in (t for t in tokens(latex) if not t.isspace()):
        depth += {"{": 1, "(": 1, "}": -1, ")": -1}.get(token, 0)
        environment += {r"\begin": 1, r"\end": -1}.get(token, 0)
        top = depth == 0 and environment == 0
        if top and token in (r"\\", ","):
            rows.append([[]])
        elif top and token in RELATIONS:
            rows[-1].append([])
        elif token not in SPACES and token not in (r"\left", r"\right") and not (top and token in "&;"):
            rows[-1][-1].append(token)
    joined = []
    for row in rows:
        if joined and row[0] == [] and len(row) > 1:  # a row that begins with a relation goes on with the one before
            joined[-1].extend(row[1:])
        elif row != [[]]:
            joined.append(row)
    while joined and joined[-1][-1] in (["."], []):
        joined[-1].pop()
    for row in joined:
        if row[-1] and row[-1][-1] == ".":
            row[-1].pop()
    return [row for row in joined if row]


class Reader:
    """Evaluates one side at one random state."""

    def __init__(self, side, seed):
        self.side, self.at, self.seed = side, 0, seed

    def value_of(self, name):
        return random.Random(f"{self.seed} {name}").uniform(0.3, 1.7)

    def peek(self):
        return self.side[self.at] if self.at < len(self.side) else None

    def next(self):
        token = self.peek()
        if token is None:
            raise Unread("the formula ends too early")
        self.at += 1
        return token

    def expect(self, token):
        if self.next() != token:
            raise Unread(f"{token} expected")

    def all(self):
        value = self.sum()
        if self.peek() is not None:
            raise Unread(f"{self.peek()} left over")
        return value

    def sum(self):
        sign = 1
        while self.peek() in ("+", "-"):
            sign *= -1 if self.next() == "-" else 1
        total = sign * self.product()
        while self.peek() in ("+", "-"):
            sign = -1 if self.next() == "-" else 1
            total += sign * self.product()
        return total

    ENDS = {None, "+", "-", ")", "]", "}", "&", r"\\", ",", r"\end"}

    def product(self, bars=False):
        value = self.factor()
        while self.peek() not in self.ENDS and not (self.peek() == "|" and self.in_bars):
            if self.peek() in (r"\cdot", r"\times"):
                operator = self.next()
                value *= self.factor() * self.value_of(operator)
            elif self.peek() == "/":
                self.next()
                value /= self.factor()
            else:
                value *= self.factor()
        return value

    in_bars = False

    def group(self):
        """The argument of a command: a group, or one token."""
        if self.peek() == "{":
            self.next()
            outer, self.in_bars = self.in_bars, False
            value = self.sum()
            self.in_bars = outer
            self.expect("}")
            return value
        token = self.next()
        return self.number(token) if token[0].isdigit() else self.value_of(token)

    def raw_group(self):
        """The text of a group or of one token."""
        if self.peek() != "{":
            return self.next()
        self.next()
        depth, text = 1, ""
        while True:
            token = self.next()
            depth += {"{": 1, "}": -1}.get(token, 0)
            if depth == 0:
                return text
            text += token

    @staticmethod
    def number(token):
        return float(token)

    def factor(self):
        base = self.base()
        while self.peek() == "^":
            self.next()
            base = base ** self.group()
        return base

    def base(self):
        token = self.next()
        if token[0].isdigit():
            return self.number(token)
        if token in ("(", "[", "{"):
            outer, self.in_bars = self.in_bars, False
            value = self.sum()
            self.in_bars = outer
            self.expect({"(": ")", "[": "]", "{": "}"}[token])
            return value
        if token == "|":
            self.in_bars, outer = True, self.in_bars
            value = abs(self.sum())
            self.expect("|")
            self.in_bars = outer
            return value
        if token in FRACTIONS:
            top = self.group()
            return top / self.group()
        if token == r"\sqrt":
            return cmath.sqrt(self.group())
        if token in FUNCTIONS:
            return self.function(FUNCTIONS[token])
        if token == r"\half":
            return 0.5
        if token == r"\pi":
            return math.pi
        if token == r"\begin":
            return self.matrix()
        if token in BIG:
            return self.big(token)
        if token in DECORATIONS:
            token += self.raw_group()
        elif token in self.ENDS or not re.fullmatch(r"[a-zA-Z]|\\[a-zA-Z]+", token):
            raise Unread(f"{token} is not known here")
        if token == "e" and self.peek() == "^":
            return math.e
        return self.symbol(token)

    def symbol(self, name):
        while self.peek() in ("_", "'", r"\prime", "*"):
            mark = self.next()
            name += mark + (self.raw_group() if mark == "_" else "")
        if self.peek() == "^" and self.at + 2 < len(self.side) and self.side[self.at + 1 : self.at + 3] == ["{", "*"]:
            self.at += 3
            name += "*"
            power = self.group_rest()
            return self.value_of(name) ** power
        return self.value_of(name)

    def group_rest(self):
        """What is left of an exponent after a star, as in E^{*2}."""
        value = 1.0 if self.peek() == "}" else self.sum()
        self.expect("}")
        return value

    def function(self, f):
        power = 1
        if self.peek() == "^":
            self.next()
            power = self.group()
        if self.peek() == "(":
            return f(self.base()) ** power
        argument = self.factor()
        stops = self.ENDS | {r"\cdot", r"\times", "/", "(", "|"} | set(FUNCTIONS) | set(FRACTIONS) | {r"\begin"} | DECORATIONS
        while self.peek() not in stops:
            argument *= self.factor()
        return f(argument) ** power

    def big(self, sign):
        value = self.value_of(sign)
        while self.peek() in ("_", "^"):
            value += self.value_of(sign + self.next()) * self.group()
        return value

    def matrix(self):
        kind = self.raw_group()
        rows = [[]]
        while self.peek() != r"\end":
            rows[-1].append(self.sum())
            if self.peek() == "&":
                self.next()
            elif self.peek() == r"\\":
                self.next()
                rows.append([])
        self.next()
        self.raw_group()
        if kind == "vmatrix":
            return determinant(rows)
        return sum(x * self.value_of(f"matrix {i} {j}") for i, row in enumerate(rows) for j, x in enumerate(row))


def determinant(rows):
    """By expansion along the first row."""
    if any(len(row) != len(rows) for row in rows):
        raise Unread("a determinant that is not square")
    if len(rows) == 1:
        return rows[0][0]
    minor = lambda j: [row[:j] + row[j + 1 :] for row in rows[1:]]
    return sum((-1) ** j * x * determinant(minor(j)) for j, x in enumerate(rows[0]))


def residuals(latex, seed):
    """For each link of each statement the difference of its sides, with their size, at the random state of this seed."""
    found = []
    for chain in statements(latex):
        values = [Reader(side, seed).all() for side in chain]
        found += [(a - b, abs(a) + abs(b)) for a, b in zip(values, values[1:])]
    return found


def differs(before, after):
    """True if the two formulas say something different in the formal reading; raises Unread where it cannot tell."""
    ratios = None
    for seed in range(6):
        try:
            old, new = residuals(before, seed), residuals(after, seed)
        except (ZeroDivisionError, OverflowError, ValueError, TypeError, IndexError) as error:
            raise Unread(str(error)) from error
        if not old or len(old) != len(new):
            raise Unread("the number of links changes")
        now = []
        for (a, size_a), (b, size_b) in zip(old, new):
            zero_a, zero_b = abs(a) < 1e-12 * size_a, abs(b) < 1e-12 * size_b
            if zero_a != zero_b:
                return True
            now.append(1.0 if zero_a else b / a)
        if ratios is not None and any(abs(r - s) > 1e-9 * (abs(r) + abs(s)) for r, s in zip(ratios, now)):
            return True
        ratios = now
    return False
