//! Premises that go in a circle: equations derived from each other.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, VecDeque};
use std::sync::Arc;

/// The most equations of a circle that are named.
const NAMED: usize = 8;

/// Equations each of which rests on the next, and the last on the first, in the order in which they rest on each other.
#[derive(Clone, Debug)]
pub(super) struct Circle {
    members: Arc<Vec<usize>>,
    /// Whose circle it is: a place among the members.
    place: usize,
}

impl Circle {
    /// Whether an equation is the first of the circle's in the notes, so that each circle is told once.
    pub fn is_told_at(&self, index: usize) -> bool {
        self.members.iter().min() == Some(&index)
    }

    /// The circle from the equation whose it is and back to it, by labels: `1 → 2 → 1`.
    pub fn text(&self, label: impl Fn(usize) -> String) -> String {
        let length = self.members.len();
        let member = |k: usize| label(self.members[(self.place + k) % length]);
        let mut labels: Vec<String> = (0..length.min(NAMED)).map(member).collect();
        if length > NAMED {
            labels.push("…".into());
        }
        labels.push(member(0));
        labels.join(" → ")
    }
}

/// A circle through each equation that lies on one. `rests[k]` are the equations on which equation k rests.
pub(super) fn circles(rests: &[Vec<usize>]) -> HashMap<usize, Circle> {
    let mut found: HashMap<usize, Circle> = HashMap::new();
    let suspects = unsettled(rests);
    for start in (0..rests.len()).filter(|k| suspects[*k]) {
        if found.contains_key(&start) {
            continue;
        }
        let Some(members) = shortest(rests, &suspects, start) else { continue };
        let members = Arc::new(members);
        for (place, member) in members.iter().enumerate() {
            found.entry(*member).or_insert_with(|| Circle { members: Arc::clone(&members), place });
        }
    }
    found
}

/// The equations that lie on a circle or rest on one that does: what is left when those that rest on nothing are
/// settled, then those that rest on settled ones only, and so on.
fn unsettled(rests: &[Vec<usize>]) -> Vec<bool> {
    let mut bears: Vec<Vec<usize>> = vec![Vec::new(); rests.len()];
    rests.iter().enumerate().for_each(|(k, on)| on.iter().for_each(|other| bears[*other].push(k)));
    let mut open: Vec<usize> = rests.iter().map(Vec::len).collect();
    let mut settled: Vec<usize> = (0..rests.len()).filter(|k| open[*k] == 0).collect();
    while let Some(k) = settled.pop() {
        for other in &bears[k] {
            open[*other] -= 1;
            if open[*other] == 0 {
                settled.push(*other);
            }
        }
    }
    open.into_iter().map(|n| n > 0).collect()
}

/// The shortest circle through an equation, if there is one.
fn shortest(rests: &[Vec<usize>], suspects: &[bool], start: usize) -> Option<Vec<usize>> {
    let mut before: HashMap<usize, usize> = HashMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(at) = queue.pop_front() {
        for &next in rests[at].iter().filter(|k| suspects[**k]) {
            if next == start {
                let mut members = vec![at];
                while let Some(&earlier) = members.last().and_then(|k| before.get(k)) {
                    members.push(earlier);
                }
                members.reverse();
                return Some(members);
            }
            if let Entry::Vacant(first) = before.entry(next) {
                first.insert(at);
                queue.push_back(next);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(rests: &[Vec<usize>]) -> Vec<String> {
        let found = circles(rests);
        (0..rests.len()).map(|k| found.get(&k).map_or(String::new(), |c| c.text(|i| i.to_string()))).collect()
    }

    #[test]
    fn circles_are_found_and_what_rests_on_them_is_none() {
        // 0 and 1 rest on each other, 2 on them, 3 on itself, 4 on nothing, 5 on 4.
        let rests = [vec![1], vec![0], vec![1, 0], vec![3], vec![], vec![4]];
        assert_eq!(told(&rests), ["0 → 1 → 0", "1 → 0 → 1", "", "3 → 3", "", ""]);
        let found = circles(&rests);
        assert!(found[&0].is_told_at(0) && !found[&1].is_told_at(1));
    }

    #[test]
    fn a_ring_of_a_hundred_thousand_takes_no_time() {
        let n = 100_000;
        let rests: Vec<Vec<usize>> = (0..n).map(|k| vec![(k + 1) % n]).collect();
        let begin = std::time::Instant::now();
        let told = told(&rests);
        assert_eq!(told[5], "5 → 6 → 7 → 8 → 9 → 10 → 11 → 12 → … → 5");
        assert!(begin.elapsed().as_secs() < 10, "{:?}", begin.elapsed());
    }
}
