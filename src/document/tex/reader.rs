//! Finding the parts of LaTeX files that matter, in the order in which TeX reads them.

use super::super::assembly::Part;
use super::super::files::{Beside, Files};
use super::super::layout::environment_arguments;
use super::super::place::Span;
use super::super::problem::Problem;
use super::super::scan::Found;
use super::commands::{counted, options, plain, verb};
use super::number::Counted;
use super::words::{self, group, macro_name};
use crate::latex::expand::{Definitions, MOST_FAULTS, definition};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What has been read so far.
pub(super) struct Reader<'a> {
    pub(super) beside: &'a dyn Beside,
    /// The folder of the main file, and the files that are being read, the innermost last.
    pub(super) folder: PathBuf,
    pub(super) reading: Vec<PathBuf>,
    pub(super) count: usize,
    /// Files that are to be read next.
    pub(super) included: Vec<(PathBuf, String)>,
    /// What is no part of the notes.
    pub(super) blank: Vec<Span>,
    /// Whether definitions have been read since the last part.
    has_defined: bool,
    /// The number of definitions that are damaged.
    faults: usize,
    /// Environments of the notes that stand for a display.
    pub(super) environments: HashMap<String, String>,
    /// Whether `\begin{document}` is still to come, and whether `\end{document}` has been passed.
    pub(super) in_preamble: bool,
    ended: bool,
    pub(super) definitions: Definitions,
    pub(super) source: String,
    pub(super) files: Files,
    pub(super) parts: Vec<Part>,
    pub(super) problems: Vec<Problem>,
    pub(super) title: Option<String>,
}

/// What opens a display.
enum Opener {
    Dollars,
    Bracket,
    Environment(String),
}

impl<'a> Reader<'a> {
    pub(super) fn new(path: &Path, beside: &'a dyn Beside) -> Self {
        Reader {
            beside,
            folder: path.parent().map(Path::to_owned).unwrap_or_default(),
            reading: Vec::new(),
            count: 0,
            included: Vec::new(),
            blank: Vec::new(),
            has_defined: false,
            faults: 0,
            definitions: Definitions::default(),
            environments: HashMap::new(),
            in_preamble: false,
            ended: false,
            source: String::new(),
            files: Files::default(),
            parts: Vec::new(),
            problems: Vec::new(),
            title: None,
        }
    }

    /// The source in which what is no part of the notes is blank.
    pub(super) fn clean(&self) -> String {
        let mut bytes = self.source.as_bytes().to_vec();
        for span in &self.blank {
            if let Some(part) = bytes.get_mut(span.clone()) {
                part.iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
            }
        }
        String::from_utf8(bytes).unwrap_or_else(|_| self.source.clone())
    }

    /// Reads a file. What it includes is put in the place of the line that says so.
    pub(super) fn file(&mut self, path: &Path, text: &str) {
        let number = self.files.add(path, text);
        self.count += 1;
        if self.reading.is_empty() {
            self.in_preamble = text.contains(r"\begin{document}");
        }
        self.reading.push(path.to_owned());
        self.files.piece(self.source.len(), number, 0);
        // Up to `copied` the text stands in the source; byte `at` of the text is byte `base + at` of the source.
        let (mut at, mut copied, mut base) = (0, 0, self.source.len());
        while let Some(ahead) = text.get(at..).filter(|_| !self.ended).and_then(|rest| rest.find(['\\', '%', '$'])) {
            at += ahead;
            at = self.at(text, base, at).max(at + 1);
            at = (at..=text.len()).find(|at| text.is_char_boundary(*at)).unwrap_or(text.len());
            if self.included.is_empty() {
                continue;
            }
            self.source.push_str(text.get(copied..at).unwrap_or_default());
            for (path, content) in std::mem::take(&mut self.included) {
                self.file(&path, &content);
            }
            self.files.piece(self.source.len(), number, at);
            (copied, base) = (at, self.source.len() - at);
        }
        self.source.push_str(text.get(copied..).unwrap_or_default());
        self.reading.pop();
    }

    /// Reads what stands at a place; where to go on.
    fn at(&mut self, text: &str, base: usize, at: usize) -> usize {
        let rest = text.get(at..).unwrap_or_default();
        if rest.starts_with('%') {
            return self.comment(text, base, at);
        }
        if let Some(opener) = self.opener(rest) {
            return if self.in_preamble { at + 1 } else { self.display(text, base, at, &opener) };
        }
        if rest.starts_with('$') || rest.starts_with(r"\(") {
            return if self.in_preamble { at + 1 } else { self.formula(text, base, at) };
        }
        match macro_name(rest) {
            "" => at + words::escaped(rest),
            name => self.word(text, base, at, name),
        }
    }

    /// A comment, or an annotation in comment lines.
    fn comment(&mut self, text: &str, base: usize, at: usize) -> usize {
        let line = text.get(..at).unwrap_or_default().rsplit('\n').next().unwrap_or_default();
        let rest = text.get(at..).unwrap_or_default();
        if line.trim().is_empty()
            && let Some((toml, length)) = words::annotation(rest)
        {
            self.blank.push(base + at..base + at + length);
            self.push(Part::Annotation(base + at..base + at + length, toml));
            return at + length;
        }
        let end = at + words::comment(rest);
        self.blank.push(base + at..base + end);
        end
    }

    /// The display that a text opens, if it does.
    fn opener(&self, rest: &str) -> Option<Opener> {
        if rest.starts_with("$$") {
            return Some(Opener::Dollars);
        } else if rest.starts_with(r"\[") {
            return Some(Opener::Bracket);
        }
        let name = match macro_name(rest) {
            "begin" => rest.get(group(rest, 6)?)?,
            name => {
                let body = self.definitions.shorthand(name)?.strip_prefix(r"\begin{")?;
                body.split_once('}').filter(|(_, behind)| behind.is_empty())?.0
            }
        };
        let name = self.environments.get(name).map_or(name, String::as_str);
        words::is_display(name).then(|| Opener::Environment(name.to_owned()))
    }

    /// The length of what closes a display at the beginning of a text, if it does.
    fn closes(&self, opener: &Opener, rest: &str) -> Option<usize> {
        match opener {
            Opener::Dollars => rest.starts_with("$$").then_some(2),
            Opener::Bracket => rest.starts_with(r"\]").then_some(2),
            Opener::Environment(name) => match macro_name(rest) {
                "end" => {
                    let found = group(rest, 4)?;
                    let ended = rest.get(found.clone())?;
                    let ended = self.environments.get(ended).map_or(ended, String::as_str);
                    (ended == name).then_some(found.end + 1)
                }
                other => {
                    let body = self.definitions.shorthand(other)?;
                    (body == format!(r"\end{{{name}}}")).then_some(1 + other.len())
                }
            },
        }
    }

    /// A display; where to go on.
    fn display(&mut self, text: &str, base: usize, at: usize, opener: &Opener) -> usize {
        let rest = text.get(at..).unwrap_or_default();
        let begin = match opener {
            Opener::Environment(name) => {
                let named = if macro_name(rest) == "begin" { group(rest, 6).map_or(0, |name| name.end + 1) } else { 0 };
                let begin = named.max(1 + macro_name(rest).len());
                begin + environment_arguments(name, rest.get(begin..).unwrap_or_default())
            }
            _ => 2,
        };
        let blanks = self.blank.len();
        let inner = at + begin;
        let Some((close, length)) = self.close(text, base, inner, opener) else {
            self.blank.truncate(blanks);
            return self.unclosed(text, base, at, inner);
        };
        let span = base + at..base + close + length;
        let environment = match opener {
            Opener::Environment(name) => Some(name.clone()),
            _ => None,
        };
        if text.get(inner..close).is_none_or(|content| content.trim().is_empty()) {
            let problem = Problem::warning("document::empty_display", "this display is empty", span.clone());
            self.problems.push(problem.help("write the formula, or remove the display"));
            self.push(Part::Found(Found::Broken { span }));
        } else {
            let content = base + inner..base + close;
            self.push(Part::Found(Found::Display { span, content, environment, name: None }));
        }
        close + length
    }

    /// Where a display is closed, and the length of what closes it. Comments in it are blanked.
    fn close(&mut self, text: &str, base: usize, inner: usize, opener: &Opener) -> Option<(usize, usize)> {
        let mut at = inner;
        loop {
            at += text.get(at..)?.find(['\\', '%', '$'])?;
            let rest = text.get(at..)?;
            if let Some(length) = self.closes(opener, rest) {
                return Some((at, length));
            }
            let is_heading = words::heading(macro_name(rest)).is_some();
            let ends = is_heading || rest.starts_with(r"\end{document}") || self.opener(rest).is_some();
            if ends {
                return None;
            }
            at += match rest.as_bytes().first()? {
                b'%' => {
                    let length = words::comment(rest);
                    self.blank.push(base + at..base + at + length);
                    length
                }
                b'\\' => words::escaped(rest),
                _ => 1,
            };
        }
    }

    /// Reports a display that is not closed and passes over it, up to the next blank line; where to go on.
    fn unclosed(&mut self, text: &str, base: usize, at: usize, inner: usize) -> usize {
        let rest = text.get(inner..).unwrap_or_default();
        let opens = |offset: usize| self.opener(rest.get(offset..).unwrap_or_default()).is_some();
        let next = rest.match_indices(['\\', '$']).map(|(offset, _)| offset).find(|offset| opens(*offset));
        let near = rest.get(..next.unwrap_or(rest.len())).unwrap_or_default();
        let end = inner + near.find("\n\n").or_else(|| near.find("\n\r\n")).unwrap_or(near.len());
        let problem = Problem::error("document::unclosed", "this display is not closed", base + at..base + inner);
        self.problems.push(
            problem.label("opened here").help("close it; it has been passed over up to the next blank line or display"),
        );
        self.push(Part::Found(Found::Broken { span: base + at..base + end }));
        end
    }

    /// An inline formula; where to go on.
    fn formula(&mut self, text: &str, base: usize, at: usize) -> usize {
        let rest = text.get(at..).unwrap_or_default();
        let (opening, closing) = if rest.starts_with('$') { (1, "$") } else { (2, r"\)") };
        let mut end = opening;
        while let Some(ahead) = rest.get(end..).and_then(|rest| rest.find(['\\', '$', '\n'])) {
            end += ahead;
            let here = rest.get(end..).unwrap_or_default();
            if here.starts_with(closing) {
                let span = base + at..base + at + end + closing.len();
                self.push(Part::Formula(span, base + at + opening..base + at + end));
                return at + end + closing.len();
            }
            let is_blank_line = here
                .strip_prefix('\n')
                .is_some_and(|line| line.trim_start_matches([' ', '\t', '\r']).starts_with('\n'));
            if is_blank_line || here.starts_with('$') || here.starts_with(r"\(") {
                break;
            }
            end += if here.starts_with('\\') { words::escaped(here) } else { 1 };
        }
        at + opening
    }

    /// A macro; where to go on.
    fn word(&mut self, text: &str, base: usize, at: usize, name: &str) -> usize {
        let behind = at + 1 + name.len();
        let behind = behind + usize::from(text.get(behind..).is_some_and(|rest| rest.starts_with('*')));
        let starred = behind > at + 1 + name.len();
        let argument = |from| group(text, from).and_then(|span| Some((text.get(span.clone())?, span.end + 1)));
        if self.faults < MOST_FAULTS
            && let Some((length, defined)) = text.get(at..).and_then(definition)
        {
            match defined {
                Ok(defined) => {
                    self.definitions.define(defined);
                    self.has_defined = true;
                }
                Err(_) => self.faults += 1,
            }
            self.blank.push(base + at..base + at + length);
            return at + length;
        }
        if let Some(level) = words::heading(name).filter(|_| !self.in_preamble) {
            return self.heading(text, base, [at, behind], level, starred);
        }
        match name {
            "begin" => self.begin(text, base, at),
            "end" if text.get(at..).is_some_and(|rest| rest.starts_with(r"\end{subequations}")) => {
                self.push(Part::Counted(base + at, Counted::End));
                behind
            }
            "end" if !self.in_preamble && text.get(at..).is_some_and(|rest| rest.starts_with(r"\end{document}")) => {
                self.ended = self.reading.len() == 1;
                text.len()
            }
            "endinput" => text.len(),
            "verb" | "lstinline" | "mintinline" => verb(text, behind),
            "newenvironment" | "renewenvironment" => self.environment(text, behind),
            "title" => match argument(options(text, behind)) {
                Some((title, end)) => {
                    self.title = Some(plain(title)).filter(|title| !title.is_empty());
                    end
                }
                None => behind,
            },
            "input" | "include" | "subfile" | "subfileinclude" | "import" | "subimport" => {
                self.included(text, base, [at, behind], name)
            }
            "usepackage" | "RequirePackage" => self.packages(text, options(text, behind)),
            "documentclass" | "LoadClass" => match argument(options(text, behind)) {
                Some((class, end)) => {
                    if ["book", "report", "scrbook", "scrreprt", "memoir", "jsbook", "jreport", "ltjsbook"]
                        .contains(&class.trim())
                    {
                        self.push(Part::Counted(base + at, Counted::Chapters));
                    }
                    end
                }
                None => behind,
            },
            "numberwithin" | "counterwithin" | "setcounter" | "addtocounter" => {
                let Some((counter, end)) = argument(options(text, behind)) else { return behind };
                let Some((value, end)) = argument(end) else { return end };
                if counter.trim() == "equation"
                    && let Some(counted) = counted(name, value.trim())
                {
                    self.push(Part::Counted(base + at, counted));
                }
                end
            }
            "appendix" => {
                self.push(Part::Counted(base + at, Counted::Appendix));
                behind
            }
            _ => behind,
        }
    }

    /// Adds a part, with the definitions before it.
    pub(super) fn push(&mut self, part: Part) {
        if std::mem::take(&mut self.has_defined) {
            self.parts.push(Part::Defined(part.start(), self.definitions.count()));
        }
        self.parts.push(part);
    }
}
