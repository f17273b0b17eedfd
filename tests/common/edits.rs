//! Random edits of notes, of the kinds that authors make.

/// A stream of random choices, the same for the same seed.
pub struct Edits(u64);

impl Edits {
    /// The choices of a seed.
    pub fn new(seed: u64) -> Self {
        Edits(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// A number below n.
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % n.max(1)
    }
}

/// Makes an edit, and says which. Blocks are what stands between blank lines: displays, annotations with them,
/// declarations, text.
pub fn edited(text: &mut String, edits: &mut Edits) -> String {
    let mut blocks: Vec<String> = text.split("\n\n").map(str::to_owned).collect();
    let at = edits.below(blocks.len());
    let other = edits.below(blocks.len());
    let (kind, shown) = (edits.below(10), blocks[at].clone());
    let what = match kind {
        0 => {
            blocks.remove(at);
            "removing"
        }
        1 => {
            blocks.insert(other, shown.clone());
            "repeating elsewhere"
        }
        2 => {
            blocks.swap(at, other);
            "exchanging"
        }
        3 => {
            let lines: Vec<&str> = shown.lines().collect();
            let gone = edits.below(lines.len());
            let left = lines.iter().enumerate().filter(|(k, _)| *k != gone).map(|(_, line)| *line);
            blocks[at] = left.collect::<Vec<_>>().join("\n");
            "removing a line of"
        }
        // Most edits are of a letter.
        _ => {
            let formulas: Vec<usize> =
                (0..blocks.len()).filter(|k| blocks[*k].contains("$$") || blocks[*k].contains("kenzan")).collect();
            let at = formulas[edits.below(formulas.len())];
            let shown = blocks[at].clone();
            let places: Vec<(usize, char)> =
                shown.char_indices().filter(|(_, c)| "+-=123456789abmIx".contains(*c)).collect();
            if places.is_empty() {
                return "nothing".into();
            }
            let (place, old) = places[edits.below(places.len())];
            let new = match old {
                '+' => '-',
                '-' | '=' => '+',
                '1'..='8' => char::from(old as u8 + 1),
                _ => "abmIx3"[edits.below(6)..].chars().next().unwrap_or('a'),
            };
            blocks[at].replace_range(place..=place, &new.to_string());
            *text = blocks.join("\n\n");
            return format!("{old} became {new} in {shown:.200}");
        }
    };
    *text = blocks.join("\n\n");
    format!("{what} {shown:.200}")
}
