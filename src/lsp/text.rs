//! Places in a text as the protocol counts them: lines from 0, and in a line units of UTF-16.

use std::ops::Range as Span;

use tower_lsp_server::ls_types::{Position, Range};

/// The place of a byte.
pub fn position(text: &str, offset: usize) -> Position {
    let offset = text.floor_char_boundary(offset);
    let before = text.get(..offset).unwrap_or(text);
    let line = before.bytes().filter(|b| *b == b'\n').count();
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    let column: usize = before[start..].chars().map(char::len_utf16).sum();
    Position::new(u32::try_from(line).unwrap_or(u32::MAX), u32::try_from(column).unwrap_or(u32::MAX))
}

/// The place of some bytes.
pub fn range(text: &str, span: &Span<usize>) -> Range {
    Range::new(position(text, span.start), position(text, span.end))
}

/// The byte at a place; the end of the line where that is shorter, the end of the text where that has fewer lines.
pub fn offset(text: &str, position: Position) -> usize {
    let mut start = 0;
    for _ in 0..position.line {
        match text[start..].find('\n') {
            Some(at) => start += at + 1,
            None => return text.len(),
        }
    }
    let line = text[start..].split('\n').next().unwrap_or_default();
    let line = line.strip_suffix('\r').unwrap_or(line);
    let mut column = 0;
    for (at, c) in line.char_indices() {
        if column >= position.character as usize {
            return start + at;
        }
        column += c.len_utf16();
    }
    start + line.len()
}

/// Puts an edit into a text; without a range it replaces all.
pub fn edit(text: &mut String, range: Option<Range>, new: &str) {
    let span = match range {
        Some(range) => {
            let (start, end) = (offset(text, range.start), offset(text, range.end));
            start.min(end)..end.max(start)
        }
        None => 0..text.len(),
    };
    text.replace_range(span, new);
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "検算 x\r\n𝜃 = a\n\nend";

    #[test]
    fn places_count_units_of_utf_16() {
        let theta = TEXT.find('𝜃').unwrap();
        assert_eq!(position(TEXT, theta), Position::new(1, 0));
        assert_eq!(position(TEXT, theta + 4), Position::new(1, 2), "a letter of two units");
        assert_eq!(position(TEXT, theta + 2), Position::new(1, 0), "not within a letter");
        assert_eq!(position(TEXT, 999), Position::new(3, 3));
        for at in TEXT.char_indices().map(|(at, _)| at).filter(|at| !TEXT[*at..].starts_with('\n')) {
            assert_eq!(offset(TEXT, position(TEXT, at)), at);
        }
        assert_eq!(offset(TEXT, Position::new(0, 99)), TEXT.find('\r').unwrap());
        assert_eq!(offset(TEXT, Position::new(99, 0)), TEXT.len());
        assert_eq!(offset(TEXT, Position::new(1, 1)), theta + 4, "the middle of a letter is behind it");
    }

    #[test]
    fn edits_are_put_in() {
        let mut text = TEXT.to_owned();
        edit(&mut text, Some(Range::new(Position::new(1, 0), Position::new(1, 2))), "b");
        assert_eq!(text, "検算 x\r\nb = a\n\nend");
        edit(&mut text, Some(Range::new(Position::new(2, 0), Position::new(2, 0))), "検");
        assert_eq!(text, "検算 x\r\nb = a\n検\nend");
        edit(&mut text, None, "all");
        assert_eq!(text, "all");
    }
}
