//! The numbers that LaTeX prints beside equations.

/// Levels of headings: `\part` is 1, `\chapter` 2, `\section` 3, and so on.
const CHAPTER: u8 = 2;
const SECTION: u8 = 3;

/// The displays that are numbered, stars aside, and whether each row is.
const NUMBERED: [(&str, bool); 8] = [
    ("equation", false),
    ("multline", false),
    ("dmath", false),
    ("align", true),
    ("alignat", true),
    ("flalign", true),
    ("gather", true),
    ("eqnarray", true),
];

/// Whether LaTeX numbers an environment.
pub fn is_numbered(environment: &str) -> bool {
    NUMBERED.iter().any(|(name, _)| *name == environment)
}

/// Whether LaTeX numbers each row of an environment.
pub fn has_numbered_rows(environment: &str) -> bool {
    NUMBERED.iter().any(|(name, rows)| *rows && *name == environment)
}

/// Something that LaTeX counts, or that changes how it counts.
#[derive(Clone, Debug, PartialEq)]
pub enum Counted {
    /// A heading of this level that is numbered.
    Heading(u8),
    /// `\documentclass{book}`: there are chapters, and equations are numbered within them.
    Chapters,
    /// `\numberwithin{equation}{section}`
    Within(u8),
    /// `\setcounter{equation}{3}`
    Set(i64),
    /// `\addtocounter{equation}{-1}`
    Add(i64),
    /// `\begin{subequations}`
    Begin,
    /// `\end{subequations}`
    End,
    /// `\appendix`
    Appendix,
}

/// The counter of equations.
#[derive(Clone, Debug, Default)]
pub struct Counter {
    equation: i64,
    /// The numbers of the current headings, by level.
    headings: [u32; 8],
    within: Option<u8>,
    has_chapters: bool,
    appendix: bool,
    /// Within `subequations`: the number of all of them, and how many there were.
    group: Option<(String, u32)>,
}

impl Counter {
    /// Counts what is no equation.
    pub fn count(&mut self, counted: Counted) {
        match counted {
            Counted::Heading(level) => {
                let at = usize::from(level.min(7));
                self.headings[at] += 1;
                if level >= CHAPTER {
                    self.headings[at + 1..].fill(0);
                    if self.within.is_some_and(|within| level <= within) {
                        self.equation = 0;
                    }
                }
            }
            Counted::Chapters => {
                self.has_chapters = true;
                self.within = Some(CHAPTER);
            }
            Counted::Within(level) => self.within = Some(level),
            Counted::Set(value) => self.equation = value,
            Counted::Add(value) => self.equation = self.equation.saturating_add(value),
            Counted::Begin => self.group = Some((self.step(), 0)),
            Counted::End => self.group = None,
            Counted::Appendix => {
                self.appendix = true;
                self.headings = [0; 8];
            }
        }
    }

    /// The number of the next equation.
    pub fn next_number(&mut self) -> String {
        match &mut self.group {
            Some((whole, count)) => {
                *count += 1;
                format!("{whole}{}", letter(*count, 'a'))
            }
            None => self.step(),
        }
    }

    fn step(&mut self) -> String {
        self.equation = self.equation.saturating_add(1);
        let first = if self.has_chapters { CHAPTER } else { SECTION };
        let mut number = String::new();
        for level in first..=self.within.unwrap_or(0).min(7) {
            let heading = self.headings[usize::from(level)];
            let is_letter = self.appendix && level == first;
            number += &if is_letter { letter(heading, 'A') } else { heading.to_string() };
            number.push('.');
        }
        number + &self.equation.to_string()
    }
}

/// The letter of a number: 1 is `a`; beyond `z` the number itself.
fn letter(number: u32, first: char) -> String {
    let offset = number.checked_sub(1).filter(|offset| *offset < 26);
    let letter = offset.and_then(|offset| char::from_u32(u32::from(first) + offset));
    letter.map_or_else(|| number.to_string(), String::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_numbered_within_sections_and_groups() {
        let mut counter = Counter::default();
        assert_eq!(counter.next_number(), "1");
        counter.count(Counted::Within(SECTION));
        counter.count(Counted::Heading(SECTION));
        assert_eq!([counter.next_number(), counter.next_number()], ["1.1", "1.2"]);
        counter.count(Counted::Begin);
        assert_eq!([counter.next_number(), counter.next_number()], ["1.3a", "1.3b"]);
        counter.count(Counted::End);
        counter.count(Counted::Heading(SECTION));
        assert_eq!(counter.next_number(), "2.1");
        counter.count(Counted::Appendix);
        counter.count(Counted::Heading(SECTION));
        assert_eq!(counter.next_number(), "A.1");
    }

    #[test]
    fn books_number_within_chapters() {
        let mut counter = Counter::default();
        counter.count(Counted::Chapters);
        counter.count(Counted::Heading(CHAPTER));
        counter.count(Counted::Heading(SECTION));
        assert_eq!(counter.next_number(), "1.1");
        counter.count(Counted::Within(SECTION));
        assert_eq!(counter.next_number(), "1.1.2");
        counter.count(Counted::Set(41));
        counter.count(Counted::Add(-1));
        assert_eq!(counter.next_number(), "1.1.41");
    }
}
