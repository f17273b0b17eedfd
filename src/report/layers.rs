//! A layered drawing of a graph: what rests on something stands below it, edges cross seldom and run straight where they
//! can (after Sugiyama, Tagawa, Toda, IEEE Trans. SMC 11 (1981) 109).
//!
//! Promise: the same graph gives the same drawing, and a graph with circles is drawn, too: an edge that closes a circle
//! is left out.

/// The most sweeps up and down by which the order within layers is bettered.
const SWEEPS: usize = 8;

/// A node to be placed: its width.
pub(super) struct Node {
    /// Its width, in the unit of [`Spacing`].
    pub width: f64,
}

/// The distances of a drawing.
pub(super) struct Spacing {
    /// Between the middles of layers.
    pub layer: f64,
    /// Between neighbours within a layer.
    pub gap: f64,
    /// What an edge that passes through a layer takes of it.
    pub edge: f64,
}

/// Where everything stands.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Drawing {
    /// The middle of each node.
    pub nodes: Vec<(f64, f64)>,
    /// Each edge that is drawn, by its index, with the points it goes through: the middles of its ends and of the layers
    /// between.
    pub edges: Vec<(usize, Vec<(f64, f64)>)>,
    /// The width of all.
    pub width: f64,
    /// The number of layers.
    pub layers: usize,
}

/// Places nodes; an edge goes from what is rested on to what rests on it.
pub(super) fn draw(nodes: &[Node], edges: &[(usize, usize)], spacing: &Spacing) -> Drawing {
    let kept = without_circles(nodes.len(), edges);
    let layer = layers(nodes.len(), edges, &kept);
    let mut grid = Grid::new(nodes, edges, &kept, &layer, spacing);
    grid.order();
    grid.place();
    grid.drawing(nodes.len(), spacing)
}

/// The edges that close no circle, by depth-first search without recursion.
fn without_circles(n: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let mut out: Vec<Vec<usize>> = vec![Vec::new(); n];
    for (k, (from, _)) in edges.iter().enumerate() {
        out[*from].push(k);
    }
    let (mut kept, mut entered, mut left) = (Vec::new(), vec![false; n], vec![false; n]);
    for root in 0..n {
        let mut path = vec![(root, 0)];
        if std::mem::replace(&mut entered[root], true) {
            continue;
        }
        while let Some((node, next)) = path.last_mut() {
            let Some(&edge) = out[*node].get(*next) else {
                left[*node] = true;
                path.pop();
                continue;
            };
            *next += 1;
            let to = edges[edge].1;
            if !entered[to] {
                entered[to] = true;
                kept.push(edge);
                path.push((to, 0));
            } else if left[to] {
                kept.push(edge);
            }
        }
    }
    kept.sort_unstable();
    kept
}

/// The layer of each node: one below the lowest that it rests on. What rests on nothing moves down to just above the
/// first that rests on it, so that edges stay short.
fn layers(n: usize, edges: &[(usize, usize)], kept: &[usize]) -> Vec<usize> {
    let mut waiting = vec![0usize; n];
    let mut out: Vec<Vec<usize>> = vec![Vec::new(); n];
    for &k in kept {
        let (from, to) = edges[k];
        waiting[to] += 1;
        out[from].push(to);
    }
    let roots: Vec<usize> = (0..n).filter(|node| waiting[*node] == 0).collect();
    let (mut layer, mut ready) = (vec![0; n], roots.clone());
    while let Some(node) = ready.pop() {
        for &to in &out[node] {
            layer[to] = layer[to].max(layer[node] + 1);
            waiting[to] -= 1;
            if waiting[to] == 0 {
                ready.push(to);
            }
        }
    }
    for root in roots {
        let first = out[root].iter().map(|to| layer[*to]).min().unwrap_or(1);
        layer[root] = first - 1;
    }
    layer
}

/// The cells of all layers: the nodes first, then a cell for each layer that an edge passes through.
struct Grid {
    width: Vec<f64>,
    layer: Vec<usize>,
    /// The cells of each layer from left to right.
    rows: Vec<Vec<usize>>,
    above: Vec<Vec<usize>>,
    below: Vec<Vec<usize>>,
    /// The cells along each edge that is drawn.
    ways: Vec<(usize, Vec<usize>)>,
    gap: f64,
    x: Vec<f64>,
}

impl Grid {
    fn new(nodes: &[Node], edges: &[(usize, usize)], kept: &[usize], layer: &[usize], spacing: &Spacing) -> Self {
        let mut width: Vec<f64> = nodes.iter().map(|n| n.width).collect();
        let mut layer = layer.to_vec();
        let mut ways = Vec::new();
        for &k in kept {
            let (from, to) = edges[k];
            let mut way = vec![from];
            for between in layer[from] + 1..layer[to] {
                way.push(width.len());
                width.push(spacing.edge);
                layer.push(between);
            }
            way.push(to);
            ways.push((k, way));
        }
        let cells = width.len();
        let (mut above, mut below) = (vec![Vec::new(); cells], vec![Vec::new(); cells]);
        for step in ways.iter().flat_map(|(_, way)| way.windows(2)) {
            above[step[1]].push(step[0]);
            below[step[0]].push(step[1]);
        }
        let mut rows = vec![Vec::new(); layer.iter().max().map_or(0, |last| last + 1)];
        layer.iter().enumerate().for_each(|(cell, l)| rows[*l].push(cell));
        let x = vec![0.0; cells];
        Grid { width, layer, rows, above, below, ways, gap: spacing.gap, x }
    }

    /// Orders each layer by the mean place of its neighbours, down and up in turn, and keeps the order with the fewest
    /// crossings.
    fn order(&mut self) {
        let mut best = (self.crossings(), self.rows.clone());
        for sweep in 0..SWEEPS {
            let down = sweep % 2 == 0;
            let mut place = vec![0.0; self.width.len()];
            for row in &self.rows {
                row.iter().enumerate().for_each(|(k, cell)| place[*cell] = k as f64);
            }
            let rows = self.rows.len();
            for k in 0..rows {
                let l = if down { k } else { rows - 1 - k };
                let neighbours = if down { &self.above } else { &self.below };
                let mean = |cell: usize| {
                    let at = &neighbours[cell];
                    if at.is_empty() {
                        place[cell]
                    } else {
                        at.iter().map(|n| place[*n]).sum::<f64>() / at.len() as f64
                    }
                };
                let mut keyed: Vec<(f64, usize)> = self.rows[l].iter().map(|c| (mean(*c), *c)).collect();
                keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
                self.rows[l] = keyed.into_iter().map(|(_, cell)| cell).collect();
                self.rows[l].iter().enumerate().for_each(|(k, cell)| place[*cell] = k as f64);
            }
            let crossings = self.crossings();
            if crossings < best.0 {
                best = (crossings, self.rows.clone());
            }
        }
        self.rows = best.1;
    }

    /// The number of pairs of steps that cross.
    fn crossings(&self) -> usize {
        let mut place = vec![0usize; self.width.len()];
        for row in &self.rows {
            row.iter().enumerate().for_each(|(k, cell)| place[*cell] = k);
        }
        let mut crossings = 0;
        for row in &self.rows {
            // The ends below, from left to right by their beginnings: each pair in the wrong order is a crossing.
            let mut ends = Vec::new();
            for cell in row {
                let mut below: Vec<usize> = self.below[*cell].iter().map(|c| place[*c]).collect();
                below.sort_unstable();
                ends.extend(below);
            }
            crossings += inversions(&mut ends);
        }
        crossings
    }

    /// Moves each cell towards the mean of its neighbours, as far as the order and the gaps let it.
    fn place(&mut self) {
        for row in &self.rows {
            let mut x = 0.0;
            for cell in row {
                self.x[*cell] = x + self.width[*cell] / 2.0;
                x += self.width[*cell] + self.gap;
            }
        }
        for _ in 0..SWEEPS {
            for l in 0..self.rows.len() {
                self.settle(l, |grid, cell| grid.above[cell].iter().chain(&grid.below[cell]).copied().collect());
            }
            for l in (0..self.rows.len()).rev() {
                self.settle(l, |grid, cell| grid.below[cell].iter().chain(&grid.above[cell]).copied().collect());
            }
        }
    }

    fn settle(&mut self, l: usize, neighbours: impl Fn(&Self, usize) -> Vec<usize>) {
        let row = &self.rows[l];
        let mut wanted = Vec::with_capacity(row.len());
        let mut offset = 0.0;
        let mut offsets = Vec::with_capacity(row.len());
        for (k, cell) in row.iter().enumerate() {
            if k > 0 {
                offset += (self.width[row[k - 1]] + self.width[*cell]) / 2.0 + self.gap;
            }
            let near = neighbours(self, *cell);
            let mean = near.iter().map(|n| self.x[*n]).sum::<f64>() / near.len().max(1) as f64;
            wanted.push(if near.is_empty() { self.x[*cell] } else { mean } - offset);
            offsets.push(offset);
        }
        let settled = nondecreasing(&wanted);
        for (k, cell) in row.iter().enumerate() {
            self.x[*cell] = settled[k] + offsets[k];
        }
    }

    fn drawing(self, nodes: usize, spacing: &Spacing) -> Drawing {
        let left = (0..self.x.len()).map(|c| self.x[c] - self.width[c] / 2.0).fold(f64::INFINITY, f64::min);
        let right = (0..self.x.len()).map(|c| self.x[c] + self.width[c] / 2.0).fold(left, f64::max);
        let at = |cell: &usize| (self.x[*cell] - left, (self.layer[*cell] as f64 + 0.5) * spacing.layer);
        Drawing {
            nodes: (0..nodes).map(|node| at(&node)).collect(),
            edges: self.ways.iter().map(|(edge, way)| (*edge, way.iter().map(at).collect())).collect(),
            width: if self.x.is_empty() { 0.0 } else { right - left },
            layers: self.rows.len(),
        }
    }
}

/// The number of pairs in the wrong order, by merging.
fn inversions(values: &mut [usize]) -> usize {
    if values.len() < 2 {
        return 0;
    }
    let (left, right) = values.split_at_mut(values.len() / 2);
    let mut count = inversions(left) + inversions(right);
    let mut merged = Vec::with_capacity(left.len() + right.len());
    let (mut i, mut j) = (0, 0);
    while i < left.len() || j < right.len() {
        if j == right.len() || (i < left.len() && left[i] <= right[j]) {
            merged.push(left[i]);
            i += 1;
        } else {
            count += left.len() - i;
            merged.push(right[j]);
            j += 1;
        }
    }
    values.copy_from_slice(&merged);
    count
}

/// The nondecreasing values nearest to those wanted, in least squares: neighbours in the wrong order share their mean.
fn nondecreasing(wanted: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for &value in wanted {
        pools.push((value, 1));
        while let [.., (a, m), (b, n)] = pools.as_slice()
            && a > b
        {
            let pool = ((a * *m as f64 + b * *n as f64) / (m + n) as f64, m + n);
            pools.truncate(pools.len() - 2);
            pools.push(pool);
        }
    }
    pools.into_iter().flat_map(|(value, n)| std::iter::repeat_n(value, n)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: Spacing = Spacing { layer: 10.0, gap: 1.0, edge: 1.0 };

    fn drawn(n: usize, edges: &[(usize, usize)]) -> Drawing {
        let nodes: Vec<Node> = (0..n).map(|_| Node { width: 4.0 }).collect();
        draw(&nodes, edges, &SPACING)
    }

    #[test]
    fn what_rests_on_something_stands_below_it() {
        let edges = [(0, 1), (1, 2), (0, 2), (3, 2)];
        let drawing = drawn(4, &edges);
        for (k, way) in &drawing.edges {
            let (from, to) = edges[*k];
            assert_eq!((way[0], way[way.len() - 1]), (drawing.nodes[from], drawing.nodes[to]));
            assert!(way.windows(2).all(|step| step[1].1 - step[0].1 == SPACING.layer), "a point in each layer");
        }
        assert_eq!(drawing.layers, 3);
        // What rests on nothing stands just above what rests on it.
        assert_eq!(drawing.nodes[3].1, drawing.nodes[1].1);
    }

    #[test]
    fn nothing_overlaps_and_all_is_inside() {
        let edges: Vec<(usize, usize)> = (0..40).flat_map(|k| [(k, k + 20), (k, (7 * k) % 19 + 40)]).collect();
        let drawing = drawn(60, &edges);
        for (a, (x, y)) in drawing.nodes.iter().enumerate() {
            assert!(*x >= 2.0 - 1e-9 && *x <= drawing.width - 2.0 + 1e-9);
            for (other, v) in &drawing.nodes[a + 1..] {
                assert!(v != y || (x - other).abs() >= 5.0 - 1e-9);
            }
        }
    }

    #[test]
    fn circles_are_cut_and_a_tree_has_no_crossings() {
        let circle = drawn(3, &[(0, 1), (1, 2), (2, 0), (1, 1)]);
        assert_eq!((circle.edges.len(), circle.layers), (2, 3));
        let tree: Vec<(usize, usize)> = (1..31).map(|k| ((k - 1) / 2, k)).rev().collect();
        let nodes: Vec<Node> = (0..31).map(|_| Node { width: 4.0 }).collect();
        let kept = without_circles(31, &tree);
        let layer = layers(31, &tree, &kept);
        let mut grid = Grid::new(&nodes, &tree, &kept, &layer, &SPACING);
        grid.order();
        assert_eq!(grid.crossings(), 0);
    }

    #[test]
    fn the_empty_and_the_long_are_drawn() {
        assert_eq!(drawn(0, &[]), Drawing::default());
        let chain: Vec<(usize, usize)> = (0..20_000).map(|k| (k, k + 1)).collect();
        let drawing = drawn(20_001, &chain);
        assert!(drawing.nodes.iter().all(|(x, _)| (x - 2.0).abs() < 1e-9), "a straight line");
    }

    #[test]
    fn crossings_are_counted() {
        assert_eq!(inversions(&mut [3, 1, 2, 2, 0]), 7);
        assert_eq!(nondecreasing(&[1.0, 3.0, 2.0, 5.0]), [1.0, 2.5, 2.5, 5.0]);
    }
}
