//! What the commands around the mathematics do: headings, environments, other files, packages.

use super::super::Section;
use super::super::assembly::Part;
use super::super::dialect::near;
use super::super::problem::Problem;
use super::number::Counted;
use super::reader::Reader;
use super::words::{self, argument, group};
use std::path::{Component, Path, PathBuf};

/// The deepest that files may include files, and the most that are included in all.
const DEEPEST: usize = 16;
const MOST_FILES: usize = 500;

impl Reader<'_> {
    /// A heading, whose title is a section's; where to go on.
    pub(super) fn heading(
        &mut self,
        text: &str,
        base: usize,
        [at, behind]: [usize; 2],
        level: u8,
        starred: bool,
    ) -> usize {
        let Some(title) = group(text, options(text, behind)) else { return behind };
        if !starred {
            self.push(Part::Counted(base + at, Counted::Heading(level)));
        }
        let end = title.end + 1;
        let title = plain(text.get(title).unwrap_or_default());
        self.push(Part::Heading(Section { title, level, span: base + at..base + end }));
        end
    }

    /// `\begin{..}` of what is no display; where to go on.
    pub(super) fn begin(&mut self, text: &str, base: usize, at: usize) -> usize {
        let Some(name) = group(text, at + 6) else { return at + 6 };
        let end = name.end + 1;
        let name = text.get(name).unwrap_or_default();
        if words::is_verbatim(name) {
            let closing = format!("\\end{{{name}}}");
            let close = text.get(end..).and_then(|rest| rest.find(&closing)).map_or(text.len(), |close| end + close);
            self.blank.push(base + end..base + close);
            return close;
        }
        match name {
            "document" => self.in_preamble = false,
            "subequations" => self.push(Part::Counted(base + at, Counted::Begin)),
            _ => {}
        }
        end
    }

    /// `\newenvironment{eqn}{\begin{equation}}{\end{equation}}`; where to go on.
    pub(super) fn environment(&mut self, text: &str, behind: usize) -> usize {
        let Some(name) = group(text, behind) else { return behind };
        let Some(begin) = group(text, options(text, options(text, name.end + 1))) else { return name.end + 1 };
        let Some(end) = group(text, begin.end + 1) else { return begin.end + 1 };
        let body = text.get(begin).unwrap_or_default().trim();
        let stands_for = body.strip_prefix(r"\begin{").and_then(|body| body.strip_suffix('}'));
        if let (Some(display), Some(name)) = (stands_for.filter(|name| words::is_display(name)), text.get(name)) {
            self.environments.insert(name.to_owned(), display.to_owned());
        }
        end.end + 1
    }

    /// `\usepackage{a,b}`: a package that stands beside the notes is read; where to go on.
    pub(super) fn packages(&mut self, text: &str, from: usize) -> usize {
        let Some(names) = group(text, from) else { return from };
        let end = names.end + 1;
        for name in text.get(names).unwrap_or_default().split(',').map(str::trim).filter(|name| !name.is_empty()) {
            self.definitions.load(name);
            let candidates = self.candidates(Path::new(&format!("{name}.sty")));
            if self.reading.len() < DEEPEST && self.count < MOST_FILES {
                self.included.extend(self.find(candidates));
            }
        }
        end
    }

    /// `\input{..}` and its like; where to go on.
    pub(super) fn included(&mut self, text: &str, base: usize, [at, behind]: [usize; 2], command: &str) -> usize {
        let mut end = behind;
        let mut path = PathBuf::new();
        for _ in 0..=usize::from(command.ends_with("import")) {
            let Some(name) = file_name(text, end) else { return end };
            path.push(text.get(name.clone()).unwrap_or_default().trim().trim_matches('"'));
            end = name.end + usize::from(text.get(name.end..).is_some_and(|rest| rest.starts_with('}')));
        }
        let span = base + at..base + end;
        let with_extension = PathBuf::from(format!("{}.tex", path.display()));
        let mut candidates = self.candidates(&with_extension);
        candidates.extend(self.candidates(&path).into_iter().filter(|path| path.extension().is_some()));
        let problem =
            |message: String, help: &str| Problem::warning("document::input", message, span.clone()).help(help);
        if let Some(around) = candidates.iter().find(|path| self.reading.contains(path)) {
            let message = format!("`{}` includes itself", around.display());
            self.problems.push(problem(message, "it is read once; remove this line"));
        } else if self.reading.len() >= DEEPEST || self.count >= MOST_FILES {
            let message = format!("at most {MOST_FILES} files are read, {DEEPEST} deep");
            self.problems.push(problem(message, "verify the parts of the notes on their own"));
        } else if let Some(found) = self.find(candidates) {
            self.included.push(found);
        } else if !self.in_preamble || text.get(at..).is_some_and(|rest| !rest.contains('@')) {
            let message = format!("there is no file `{}`", with_extension.display());
            let help = "files are looked for beside the main file and beside the file that includes them";
            self.problems.push(problem(message, help));
        }
        end
    }

    /// Where a file may be: in the folder of the main file, or of the file that includes it. None outside of the notes'
    /// own disk: absolute paths are not followed.
    fn candidates(&self, path: &Path) -> Vec<PathBuf> {
        if path.components().any(|part| matches!(part, Component::RootDir | Component::Prefix(_))) {
            return Vec::new();
        }
        let mut found = vec![self.folder.join(path)];
        if let Some(folder) = self.reading.last().and_then(|reading| reading.parent())
            && folder != self.folder
        {
            found.push(folder.join(path));
        }
        found
    }

    /// The first of these files that is there, with its text.
    fn find(&self, candidates: Vec<PathBuf>) -> Option<(PathBuf, String)> {
        let candidates = candidates.into_iter().filter(|path| !self.reading.contains(path));
        candidates.into_iter().find_map(|path| self.beside.text(&path).map(|text| (path, text)))
    }
}

/// The name in `\input{name}` or `\input name`.
fn file_name(text: &str, from: usize) -> Option<super::super::Span> {
    if let Some(name) = group(text, from) {
        return Some(name);
    }
    let rest = text.get(from..)?;
    let start = from + (rest.len() - rest.trim_start_matches(' ').len());
    let rest = text.get(start..)?;
    let end = rest.find(|c: char| c.is_whitespace() || matches!(c, '\\' | '{' | '}' | '%')).unwrap_or(rest.len());
    (start > from && end > 0).then_some(start..start + end)
}

/// Where the arguments in braces begin, behind options in brackets.
pub(super) fn options(text: &str, from: usize) -> usize {
    argument(text, from, ['[', ']']).map_or(from, |option| option.end + 1)
}

/// Behind `\verb|..|`.
pub(super) fn verb(text: &str, from: usize) -> usize {
    let from = options(text, from);
    let rest = text.get(from..).unwrap_or_default();
    let Some(mark) = rest.chars().next().filter(|mark| !mark.is_alphanumeric()) else { return from };
    let closing = if mark == '{' { '}' } else { mark };
    let line = near(rest, 0, 500).lines().next().unwrap_or_default();
    let inside = line.get(mark.len_utf8()..).unwrap_or_default();
    inside.find(closing).map_or(from, |end| from + mark.len_utf8() + end + closing.len_utf8())
}

/// What `\numberwithin{equation}{section}` and the like change.
pub(super) fn counted(command: &str, value: &str) -> Option<Counted> {
    match command {
        "setcounter" => value.parse().ok().map(Counted::Set),
        "addtocounter" => value.parse().ok().map(Counted::Add),
        _ => words::heading(value).map(Counted::Within),
    }
}

/// The words of a title: line breaks, labels and footnotes left out, fonts taken off.
pub(super) fn plain(title: &str) -> String {
    let mut words = String::new();
    let mut rest = title;
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        match c {
            '$' => {
                let end = rest.get(1..).and_then(|inside| inside.find('$')).map_or(1, |end| end + 2);
                words.push_str(rest.get(..end).unwrap_or_default());
                length = end;
            }
            '\\' => {
                let name = words::macro_name(rest);
                length = if name.is_empty() { words::escaped(rest) } else { 1 + name.len() };
                if matches!(name, "label" | "thanks" | "footnote" | "vspace" | "hspace") {
                    length = group(rest, length).map_or(length, |argument| argument.end + 1);
                } else if name.is_empty() && !rest.starts_with(r"\\") {
                    words.push_str(rest.get(1..length).unwrap_or_default());
                } else {
                    words.push(' ');
                }
            }
            '%' => length = words::comment(rest),
            '~' => words.push(' '),
            '{' | '}' => {}
            _ => words.push(c),
        }
        rest = rest.get(length..).unwrap_or_default();
    }
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}
