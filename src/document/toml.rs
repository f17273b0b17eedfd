//! The TOML of annotations: values that know their place in the file, and readers of values that say what is wrong.

use super::place::{Span, Spanned};
use super::problem::{Problem, nearest};
use crate::latex::expand::Macros;
use ::toml::de::{DeTable, DeValue};

/// A TOML value with its place in the file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Value {
    pub(super) kind: Kind,
    pub(super) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A text; its span is that of the letters where they stand verbatim between the quotes.
    Text(Spanned<String>),
    /// A number, and how it is written.
    Number(f64, String),
    Bool(bool),
    Array(Vec<Value>),
    Table(Table),
    Date,
}

/// The entries of a table in the order of the file.
pub(super) type Table = Vec<(Spanned<String>, Value)>;

/// TOML as it stands in a file.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The TOML: the bytes of the file, in which what is none (the `%!` before each line) is blank.
    pub(super) text: &'a str,
    /// Where it begins in the file.
    pub(super) offset: usize,
    /// The macros with which its LaTeX is written.
    pub(super) macros: &'a Macros,
}

/// Reads the TOML of an annotation. A text that holds a control character is a problem, too: `"\theta"` in double
/// quotes is a tab and `heta`.
pub(super) fn parse(source: Source, problems: &mut Vec<Problem>) -> Option<Table> {
    match DeTable::parse(source.text) {
        Ok(table) => Some(Placer { source, problems }.table(table.into_inner())),
        Err(error) => {
            let within = whole_characters(source.text, error.span().unwrap_or(0..source.text.len()));
            let span = source.offset + within.start..source.offset + within.end;
            let problem = Problem::error("document::toml", "the annotation is not valid TOML", span);
            problems.push(problem.label(error.message().replace('\n', ", ")).help(IN_SINGLE_QUOTES));
            None
        }
    }
}

/// The most entries of a declared matrix.
const MOST_ENTRIES: f64 = 1000.0;

const IN_SINGLE_QUOTES: &str =
    r"write LaTeX in single quotes, where a backslash is a backslash: reading = 'a = \theta'";

/// The span widened to whole characters, and to one character where it is empty and one is there.
fn whole_characters(source: &str, span: Span) -> Span {
    let start = (0..=span.start.min(source.len())).rfind(|at| source.is_char_boundary(*at)).unwrap_or(0);
    let end = (span.end.max(start)..=source.len()).find(|at| source.is_char_boundary(*at)).unwrap_or(source.len());
    start..end
}

/// Gives TOML's values their places in the file.
struct Placer<'a> {
    source: Source<'a>,
    problems: &'a mut Vec<Problem>,
}

impl Placer<'_> {
    fn span(&self, span: Span) -> Span {
        self.source.offset + span.start..self.source.offset + span.end
    }

    /// What is written in the file.
    fn written(&self, span: &Span) -> &str {
        let local = span.start - self.source.offset..span.end - self.source.offset;
        self.source.text.get(local).unwrap_or_default()
    }

    fn table(&mut self, table: DeTable) -> Table {
        let mut entries: Table = Vec::new();
        for (key, value) in table {
            let span = self.span(key.span());
            let key = self.text(key.into_inner().into_owned(), span);
            entries.push((key, self.value(value)));
        }
        entries.sort_by_key(|(key, _)| key.span.start);
        entries
    }

    /// TOML itself limits how deep values nest, and so this recursion.
    fn value(&mut self, value: ::toml::Spanned<DeValue>) -> Value {
        let span = self.span(value.span());
        let written = self.written(&span).to_owned();
        let kind = match value.into_inner() {
            DeValue::String(text) => Kind::Text(self.text(text.into_owned(), span.clone())),
            DeValue::Integer(number) => {
                let value = i64::from_str_radix(number.as_str(), number.radix()).map_or(f64::NAN, |value| value as f64);
                Kind::Number(value, written)
            }
            DeValue::Float(number) => Kind::Number(number.as_str().parse().unwrap_or(f64::NAN), written),
            DeValue::Boolean(value) => Kind::Bool(value),
            DeValue::Datetime(_) => Kind::Date,
            DeValue::Table(table) => Kind::Table(self.table(table)),
            DeValue::Array(values) => Kind::Array(values.into_iter().map(|value| self.value(value)).collect()),
        };
        Value { kind, span }
    }

    /// A text with its macros expanded.
    fn text(&mut self, text: String, span: Span) -> Spanned<String> {
        let written = self.placed(text, span);
        match self.source.macros.expand(&written.value) {
            Ok(expanded) if expanded.is_verbatim() => written,
            Ok(mut expanded) => {
                // A text of another length than what is written has the place of the whole.
                if expanded.text.len() == written.span.len() {
                    expanded.text.push(' ');
                }
                Spanned::new(expanded.text, written.span)
            }
            Err(error) => {
                let place = written.place(error.span);
                let problem = Problem::error("document::macro", error.message, place);
                self.problems.push(Problem { help: error.help, ..problem });
                written
            }
        }
    }

    /// A text at the place of its letters, where they stand in the file as they are, else at the place of the whole value.
    fn placed(&mut self, text: String, span: Span) -> Spanned<String> {
        let written = self.written(&span);
        let quotes = written.bytes().take_while(|byte| matches!(byte, b'\'' | b'"')).take(3).count();
        let quotes = if text.is_empty() { written.len() / 2 } else { quotes };
        let line_break = written.get(quotes..).map_or(0, |rest| match rest {
            _ if quotes < 3 || rest.starts_with(&text) => 0,
            rest => rest.find('\n').map_or(0, |at| at + 1),
        });
        let start = quotes + line_break;
        if written.get(start..).is_some_and(|rest| rest.starts_with(&text)) {
            return Spanned::new(text.clone(), span.start + start..span.start + start + text.len());
        }
        if let Some(control) = text.chars().find(|c| c.is_control()) {
            let problem =
                Problem::error("document::control_character", "a macro was taken for an escape", span.clone());
            let label = format!("this text holds the control character {}", control.escape_debug());
            self.problems.push(problem.label(label).help(IN_SINGLE_QUOTES));
        }
        Spanned::new(text, span)
    }
}

/// A key as it is to be written.
fn written(key: &Spanned<String>) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    if !key.value.is_empty() && key.value.chars().all(is_bare) { key.value.clone() } else { format!("'{}'", key.value) }
}

/// Reads values as what a key demands. Everything that does not fit becomes a problem and nothing else.
pub(super) struct Reader<'a> {
    pub(super) problems: &'a mut Vec<Problem>,
}

impl Reader<'_> {
    /// Reports that a value is not what the key demands.
    pub(super) fn wrong(&mut self, key: &Spanned<String>, value: &Value, expected: &str, example: &str) {
        let found = match &value.kind {
            Kind::Text(_) => "a text",
            Kind::Number(..) => "a number",
            Kind::Bool(_) => "true or false",
            Kind::Array(_) => "a list",
            Kind::Table(_) => "a table",
            Kind::Date => "a date",
        };
        let message = format!("`{}` must be {expected}", key.value);
        let problem = Problem::error("document::wrong_type", message, value.span.clone());
        self.problems.push(problem.label(format!("this is {found}")).help(format!("for example: {example}")));
    }

    /// Reports a key that is not known here, with the known one that was probably meant.
    pub(super) fn unknown(&mut self, key: &Spanned<String>, owner: &str, known: &[&str]) {
        let message = format!("{owner} has no key `{}`", key.value);
        let problem = Problem::error("document::unknown_key", message, key.span.clone());
        self.problems.push(match nearest(&key.value, known) {
            Some(near) => problem.label(format!("did you mean `{near}`?")),
            None => problem.label("not known here").help(format!("known keys: {}", known.join(", "))),
        });
    }

    pub(super) fn text(&mut self, key: &Spanned<String>, value: &Value) -> Option<Spanned<String>> {
        match &value.kind {
            Kind::Text(text) => Some(text.clone()),
            _ => {
                self.wrong(key, value, "a text", &format!("{} = 'text'", written(key)));
                None
            }
        }
    }

    /// A text out of a few.
    pub(super) fn word(&mut self, key: &Spanned<String>, value: &Value, known: &[&str]) -> Option<Spanned<String>> {
        let text = self.text(key, value)?;
        if known.contains(&text.value.as_str()) {
            return Some(text);
        }
        let message = format!("`{}` cannot be `{}`", key.value, text.value);
        let problem = Problem::error("document::unknown_value", message, text.span.clone());
        self.problems.push(match nearest(&text.value, known) {
            Some(near) => problem.label(format!("did you mean `{near}`?")),
            None => problem.label("not known here").help(format!("one of: {}", known.join(", "))),
        });
        None
    }

    /// Texts: a list of them, or one alone.
    pub(super) fn texts(&mut self, key: &Spanned<String>, value: &Value) -> Vec<Spanned<String>> {
        let values = match &value.kind {
            Kind::Array(values) => values.as_slice(),
            _ => std::slice::from_ref(value),
        };
        let mut texts = Vec::new();
        for value in values {
            match &value.kind {
                Kind::Text(text) => texts.push(text.clone()),
                _ => self.wrong(key, value, "a text or a list of texts", &format!("{} = ['39', '40']", written(key))),
            }
        }
        texts
    }

    /// Three texts.
    pub(super) fn three(&mut self, key: &Spanned<String>, value: &Value) -> Option<[Spanned<String>; 3]> {
        if let Kind::Array(values) = &value.kind {
            let texts = values.iter().filter_map(|value| match &value.kind {
                Kind::Text(text) => Some(text.clone()),
                _ => None,
            });
            if let (3, Ok(three)) = (values.len(), texts.collect::<Vec<_>>().try_into()) {
                return Some(three);
            }
        }
        self.wrong(key, value, "a list of three texts", &format!(r"{} = ['\xi', '\eta', '\zeta']", written(key)));
        None
    }

    pub(super) fn bool(&mut self, key: &Spanned<String>, value: &Value) -> bool {
        match value.kind {
            Kind::Bool(value) => value,
            _ => {
                self.wrong(key, value, "true or false", &format!("{} = true", written(key)));
                false
            }
        }
    }

    pub(super) fn number(&mut self, key: &Spanned<String>, value: &Value) -> Option<f64> {
        match value.kind {
            Kind::Number(number, _) if number.is_finite() => Some(number),
            _ => {
                self.wrong(key, value, "a number", &format!("{} = 2", written(key)));
                None
            }
        }
    }

    /// A whole number, zero or more.
    pub(super) fn count(&mut self, key: &Spanned<String>, value: &Value) -> Option<usize> {
        match value.kind {
            Kind::Number(number, _) if (0.0..=1e9).contains(&number) && number.fract() == 0.0 => Some(number as usize),
            _ => {
                self.wrong(key, value, "a whole number, zero or more", &format!("{} = 2", written(key)));
                None
            }
        }
    }

    /// Two numbers, the smaller first.
    pub(super) fn range(&mut self, key: &Spanned<String>, value: &Value) -> Option<[f64; 2]> {
        let example = format!("{} = [0.5, 2.0]", written(key));
        let [low, high] = self.pair(key, value, "a list of two numbers, the smaller first", &example)?;
        if !low.is_finite() || !high.is_finite() {
            let problem = Problem::error("document::range", "a range must be finite", value.span.clone());
            self.problems.push(problem.label("values are drawn from here").help(format!("for example: {example}")));
            return None;
        }
        if low > high {
            let problem = Problem::error("document::range", "this range is the wrong way round", value.span.clone());
            self.problems
                .push(problem.label("the first number is the larger").help(format!("write [{high:?}, {low:?}]")));
            return None;
        }
        Some([low, high])
    }

    /// Two whole numbers, the smaller first.
    pub(super) fn index_range(&mut self, key: &Spanned<String>, value: &Value) -> Option<[i64; 2]> {
        let [low, high] = self.range(key, value)?;
        if low.fract() != 0.0 || high.fract() != 0.0 || low.abs() > 1e9 || high.abs() > 1e9 {
            self.wrong(key, value, "a list of two whole numbers", &format!("{} = [1, 4]", written(key)));
            return None;
        }
        Some([low as i64, high as i64])
    }

    /// Two whole numbers greater than zero: rows and columns.
    pub(super) fn shape(&mut self, key: &Spanned<String>, value: &Value) -> Option<[usize; 2]> {
        let expected = "a list of two whole numbers: rows, columns";
        let example = format!("{} = [3, 3]", written(key));
        let shape = self.pair(key, value, expected, &example)?;
        if shape.iter().any(|size| !(1.0..=1e4).contains(size) || size.fract() != 0.0) {
            self.wrong(key, value, expected, &example);
            return None;
        }
        if shape[0] * shape[1] > MOST_ENTRIES {
            let message = format!("a matrix of {} entries; at most {MOST_ENTRIES} are read", shape[0] * shape[1]);
            let problem = Problem::error("document::matrix", message, value.span.clone());
            self.problems
                .push(problem.label("each entry is a symbol of its own").help("a handful shows what any number does"));
            return None;
        }
        Some(shape.map(|size| size as usize))
    }

    fn pair(&mut self, key: &Spanned<String>, value: &Value, expected: &str, example: &str) -> Option<[f64; 2]> {
        if let Kind::Array(values) = &value.kind
            && let [Value { kind: Kind::Number(first, _), .. }, Value { kind: Kind::Number(second, _), .. }] =
                values.as_slice()
        {
            return Some([*first, *second]);
        }
        self.wrong(key, value, expected, example);
        None
    }

    pub(super) fn table<'v>(
        &mut self,
        key: &Spanned<String>,
        value: &'v Value,
        example: &str,
    ) -> &'v [(Spanned<String>, Value)] {
        match &value.kind {
            Kind::Table(table) => table,
            _ => {
                self.wrong(key, value, "a table", example);
                &[]
            }
        }
    }
}
