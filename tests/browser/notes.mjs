// Notes of any number of equations, for measuring: `node notes.mjs 2000`. They are of the kinds that notes have: identities,
// chains, what follows from what stands before, and every twentieth with a misprint and its correction.
const total = Number(process.argv[2] ?? 200);
const lines = ["# Notes of " + total + " equations", ""];
for (let n = 1; n <= total; n += 1) {
  if (n % 25 === 1) {
    lines.push(`## ${(n - 1) / 25 + 1} Rotation about the axis ${(n - 1) / 25 + 1}`, "", "<!-- kenzan", "[symbols]",
      "'a, b, c, I_0, I_1, L_z' = { range = [0.5, 2.0] }", "'\\theta, \\varphi' = { range = [0.2, 1.2] }", "-->", "");
  }
  const k = n % 7 + 2;
  const body = [
    `\\sin^2 ${k} \\theta + \\cos^2 ${k} \\theta = 1`,
    `\\frac{L_z - I_1 b \\cos\\theta}{I_0 \\sin^2\\theta} = \\frac{L_z}{I_0 \\sin^2\\theta} - \\frac{I_1 b \\cos\\theta}{I_0 \\sin^2\\theta}`,
    `(a + ${k} b)^2 = a^2 + ${2 * k} a b + ${k * k} b^2 = a (a + ${2 * k} b) + ${k * k} b^2`,
    `\\begin{pmatrix} a & b \\\\ c & ${k} a \\end{pmatrix} \\begin{pmatrix} b \\\\ c \\end{pmatrix} = \\begin{pmatrix} a b + b c \\\\ b c + ${k} a c \\end{pmatrix}`,
    `\\sqrt{a^2 + b^2 + 2 a b} = a + b`,
  ][n % 5];
  const wrong = n % 20 === 0;
  lines.push(`$$ ${wrong ? `a^2 - ${k * k} b^2 = (a - ${k} b)(a - ${k} b)` : body} \\tag{${n}} $$`);
  const given = n % 25 > 1 && n % 3 === 0 ? `given = ["${n - 1}"]\n` : "";
  const correction = wrong ? `correction = 'a^2 - ${k * k} b^2 = (a - ${k} b)(a + ${k} b)'\nexpect = "fails"\n` : "";
  if (given || correction) lines.push(`<!-- kenzan\n${given}${correction}-->`);
  lines.push("", "And so it goes on with the next equation.", "");
}
console.log(lines.join("\n"));
