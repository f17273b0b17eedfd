//! Katex's MathML made ready for a page: the same bytes each time, and what browsers leave out of MathML put in.
//!
//! Browsers draw MathML Core, which knows nothing of `columnalign` and `columnspacing`, and of `mathvariant` only
//! `normal`. Columns become classes of their cells, script, fraktur and blackboard letters become the letters that
//! Unicode has for them; bold is left to the style sheet, because not every device has a font with Unicode's bold letters.

use super::math::MARK;

/// The `math` element of katex's output, without the copy of the source that katex adds, and with marks made classes.
/// Attributes are in alphabetical order: katex keeps them in a hash table, whose order differs from run to run.
///
/// Only the elements and attributes of [`ELEMENTS`] and [`ATTRIBUTES`] pass: nothing that runs, links or loads.
///
/// `None` if there is no `math` element, or one that is not known. Katex escapes `<` and `>` in texts and attribute values, so each of them left
/// begins or ends a tag.
pub(super) fn canonical(markup: &str) -> Option<String> {
    let begin = markup.find("<math")?;
    let end = markup.rfind("</math>")? + "</math>".len();
    let mut writer = Writer { html: String::with_capacity(markup.len()), ..Writer::default() };
    let mut rest = markup.get(begin..end)?;
    while let Some(open) = rest.find('<') {
        writer.html.push_str(&rest[..open]);
        let length = rest[open..].find('>')? + 1;
        let tag = Tag::read(&rest[open..open + length]);
        rest = &rest[open + length..];
        match tag.name {
            "annotation" => rest = &rest[rest.find("</annotation>")? + "</annotation>".len()..],
            "semantics" | "/semantics" => {}
            name if !ELEMENTS.contains(&name.trim_start_matches('/')) => return None,
            _ => writer.tag(&tag, rest),
        }
        if let Some(variant) = tag.attribute("mathvariant") {
            let text = &rest[..rest.find('<')?];
            writer.html.extend(text.chars().map(|c| letter(c, variant)));
            rest = &rest[text.len()..];
        }
    }
    writer.html.push_str(rest);
    Some(writer.html)
}

/// The elements that pass.
const ELEMENTS: [&str; 23] = [
    "math",
    "menclose",
    "mfrac",
    "mi",
    "mn",
    "mo",
    "mover",
    "mpadded",
    "mphantom",
    "mroot",
    "mrow",
    "mspace",
    "msqrt",
    "mstyle",
    "msub",
    "msubsup",
    "msup",
    "mtable",
    "mtd",
    "mtext",
    "mtr",
    "munder",
    "munderover",
];

/// The attributes that pass, where they are words, numbers, lengths or colours.
const ATTRIBUTES: [&str; 26] = [
    "accent",
    "accentunder",
    "columnlines",
    "depth",
    "display",
    "displaystyle",
    "fence",
    "form",
    "height",
    "linethickness",
    "lspace",
    "mathbackground",
    "mathcolor",
    "mathsize",
    "mathvariant",
    "maxsize",
    "minsize",
    "movablelimits",
    "notation",
    "rowlines",
    "rspace",
    "scriptlevel",
    "separator",
    "stretchy",
    "voffset",
    "width",
];

/// Whether an attribute passes.
fn passes(key: &str, value: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '#' | '.' | '%' | '+' | '-' | ' ');
    ATTRIBUTES.contains(&key) && value.chars().all(plain)
}

#[derive(Default)]
struct Writer {
    html: String,
    /// The open elements, and whether each holds the name of a function without its argument: the base of `\sin^2`.
    open: Vec<(String, bool)>,
    tables: Vec<Table>,
}

impl Writer {
    /// Writes a tag, `rest` being what follows it. Thin spaces set functions off from factors and arguments, as in TeX.
    fn tag(&mut self, tag: &Tag<'_>, rest: &str) {
        if let Some(name) = tag.name.strip_prefix('/') {
            self.html.push_str(&tag.write(&mut self.tables));
            let base = self.open.pop().is_some_and(|(_, base)| base);
            if base && name.starts_with("ms") && begins_argument(rest) {
                self.space();
            }
            return;
        }
        let function = tag.name == "mi"
            && rest
                .split_once("</mi><mo>")
                .is_some_and(|(name, after)| !name.contains('<') && after.starts_with(APPLICATION));
        if function && ends_with_factor(&self.html) {
            self.space();
        }
        if tag.name == "mo" && rest.strip_prefix(APPLICATION).is_some_and(|r| r.starts_with("</mo></mrow>")) {
            // The function's name alone stands in a row that is the base of scripts.
            self.open.iter_mut().rev().nth(1).into_iter().for_each(|(_, base)| *base = true);
        }
        let argument = rest.strip_prefix(APPLICATION).and_then(|r| r.strip_prefix("</mo>"));
        if tag.name == "mo" && argument.is_some_and(begins_argument) {
            self.html.push_str("<mo rspace=\"0.1667em\">");
        } else {
            self.html.push_str(&tag.write(&mut self.tables));
        }
        if !tag.empty {
            self.open.push((tag.name.to_owned(), false));
        }
    }

    /// A thin space, where another element in the row does no harm: a fraction or a script counts its elements.
    fn space(&mut self) {
        if self.open.last().is_some_and(|(name, _)| matches!(name.as_str(), "math" | "mrow" | "mstyle" | "mtd")) {
            self.html.push_str("<mspace width=\"0.1667em\"></mspace>");
        }
    }
}

/// Whether an operand follows: not an operator or a bracket, nor the end of the row.
fn begins_argument(rest: &str) -> bool {
    !rest.starts_with("</") && !rest.starts_with("<mo")
}

/// Whether what has been written last is an operand that is complete.
fn ends_with_factor(html: &str) -> bool {
    html.rfind('<').is_some_and(|tag| html[tag..].starts_with("</") && &html[tag..] != "</mo>")
}

/// The invisible operator that katex puts after the name of a function.
const APPLICATION: &str = "\u{2061}";

/// A tag: `mi`, `/mi`.
struct Tag<'a> {
    name: &'a str,
    attributes: Vec<(&'a str, &'a str)>,
    empty: bool,
}

/// An open table: how its columns are aligned, and how many cells its row has so far.
struct Table {
    columns: Vec<String>,
    cell: usize,
}

impl<'a> Tag<'a> {
    /// Reads `<name key="value" ...>`.
    fn read(tag: &'a str) -> Self {
        let inner = tag.trim_start_matches('<').trim_end_matches('>');
        let empty = inner.ends_with('/');
        let (name, mut rest) = inner.trim_end_matches('/').split_once(' ').unwrap_or((inner, ""));
        let mut attributes = Vec::new();
        while let Some((key, after)) = rest.split_once("=\"") {
            let Some((value, after)) = after.split_once('"') else { break };
            attributes.push((key.trim(), value));
            rest = after;
        }
        attributes.sort_unstable();
        Tag { name, attributes, empty }
    }

    fn attribute(&self, key: &str) -> Option<&'a str> {
        self.attributes.iter().find(|(k, _)| *k == key).map(|(_, value)| *value)
    }

    /// The tag again, with classes for what MathML Core leaves out.
    fn write(&self, tables: &mut Vec<Table>) -> String {
        let mut class = None;
        match self.name {
            "mtable" => {
                let columns = self.attribute("columnalign").unwrap_or_default();
                tables.push(Table { columns: columns.split(' ').map(String::from).collect(), cell: 0 });
                let tight = self.attribute("columnspacing").is_some_and(|s| s.starts_with("0em"));
                class = tight.then_some("tight");
            }
            "/mtable" => drop(tables.pop()),
            "mtr" => tables.iter_mut().rev().take(1).for_each(|table| table.cell = 0),
            "mtd" => class = tables.last_mut().and_then(Table::next_cell),
            _ => {}
        }
        let mut html = format!("<{}", self.name);
        if self.attribute("mathcolor") == Some(MARK) {
            class = Some("changed");
        }
        html.extend(class.map(|class| format!(" class=\"{class}\"")));
        let kept = self.attributes.iter().filter(|(key, value)| *value != MARK && passes(key, value));
        html.extend(kept.map(|(key, value)| format!(" {key}=\"{value}\"")));
        html + if self.empty { "/>" } else { ">" }
    }
}

impl Table {
    /// The class of the next cell; the last alignment holds for the columns after it.
    fn next_cell(&mut self) -> Option<&'static str> {
        let column = self.columns.get(self.cell).or(self.columns.last());
        self.cell += 1;
        match column?.as_str() {
            "left" => Some("left"),
            "right" => Some("right"),
            _ => None,
        }
    }
}

/// A letter in a style that only Unicode can express; itself where there is none.
fn letter(c: char, variant: &str) -> char {
    // Where Unicode had the letter before it had the alphabet, the alphabet has a hole.
    let (capital, holes) = match variant {
        "script" => ('\u{1d49c}', "BℬEℰFℱHℋIℐLℒMℳRℛeℯgℊoℴ"),
        "fraktur" => ('\u{1d504}', "CℭHℌIℑRℜZℨ"),
        "double-struck" => ('\u{1d538}', "CℂHℍNℕPℙQℚRℝZℤ"),
        _ => return c,
    };
    if let Some(at) = holes.chars().step_by(2).position(|hole| hole == c) {
        return holes.chars().nth(2 * at + 1).unwrap_or(c);
    }
    let offset = match c {
        'A'..='Z' => u32::from(c) - u32::from('A'),
        'a'..='z' => u32::from(c) - u32::from('a') + 26,
        _ => return c,
    };
    char::from_u32(u32::from(capital) + offset).unwrap_or(c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::math::Renderer;

    #[test]
    fn attributes_are_sorted_and_sources_dropped() {
        let markup = r#"<span><math xmlns="x" display="block"><semantics><mo stretchy="false" fence="true">+</mo><annotation encoding="y">a&lt;b</annotation></semantics></math></span>"#;
        assert_eq!(
            canonical(markup).unwrap(),
            r#"<math display="block"><mo fence="true" stretchy="false">+</mo></math>"#
        );
        assert_eq!(canonical("no mathematics"), None);
    }

    #[test]
    fn what_runs_links_or_loads_does_not_pass() {
        let markup =
            r#"<math href="javascript:x" onclick="y" style="z"><mi mathcolor="url(x)" width="1em">a</mi></math>"#;
        assert_eq!(canonical(markup).unwrap(), r#"<math><mi width="1em">a</mi></math>"#);
        for element in ["script", "a", "mglyph", "maction", "annotation-xml", "img"] {
            assert_eq!(canonical(&format!("<math><{element}>x</{element}></math>")), None, "{element}");
        }
    }

    #[test]
    fn columns_become_classes_of_cells_in_nested_tables_too() {
        let html =
            Renderer::new().display(r"\begin{aligned} a &= \begin{matrix} 1 & 2 \end{matrix} \\ b &= c \end{aligned}");
        let cells: Vec<_> = html.split("<mtd").skip(1).map(|cell| cell.split('>').next().unwrap_or_default()).collect();
        let (right, left, centre) = (" class=\"right\"", " class=\"left\"", "");
        assert_eq!(cells, [right, left, centre, centre, right, left], "{html}");
        assert!(html.contains("<mtable class=\"tight\">"), "{html}");
    }

    #[test]
    fn functions_stand_off_from_factors_but_not_from_brackets() {
        let html = Renderer::new().display(r"a \sin \theta + \cos(b)");
        let space = "<mspace width=\"0.1667em\"></mspace>";
        let expected = format!("<mi>a</mi>{space}<mi>sin</mi><mo rspace=\"0.1667em\">\u{2061}</mo><mi>θ</mi>");
        assert!(html.contains(&expected), "{html}");
        let html = Renderer::new().display(r"\frac{\sin^2 \theta}{\sin^2}");
        assert_eq!(html.matches("<mspace").count(), 1, "{html}");
        let html = Renderer::new().display(r"a + \cos(b)");
        assert!(html.contains("<mo>+</mo><mi>cos</mi><mo>\u{2061}</mo><mo stretchy=\"false\">("), "{html}");
    }

    #[test]
    fn letters_of_other_alphabets_are_unicode() {
        let html = Renderer::new().display(r"\mathcal{HA} + \mathbb{R} + \mathfrak{g} + \mathbf{e}");
        for letter in ["ℋ", "𝒜", "ℝ", "𝔤"] {
            assert!(html.contains(letter), "{letter} in {html}");
        }
        assert!(html.contains("<mi mathvariant=\"bold\">e</mi>"), "{html}");
    }
}
