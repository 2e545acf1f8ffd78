//! Weighted sums over common terms, and a greedy search for partial sums worth sharing.

use std::collections::HashMap;

use crate::graph::NodeHash;

/// What is summed: a value known before, or the partial sum that [`Forms::rows`] holds for it.
pub type Term = u32;

/// The term that stands for the number one; its weight is a constant summand and needs no multiplication.
pub const ONE: Term = 0;

/// A weighted sum, by term.
pub type Row = Vec<(Term, f64)>;

/// Sums to be computed together.
pub struct Forms {
    /// The sums asked for, then one row of two terms for each partial sum made.
    pub rows: Vec<Row>,
    /// The first term that is a partial sum: term `partial_terms + k` is row `asked + k`.
    partial_terms: Term,
    asked: usize,
    /// How many rows use each product of a term and a weight's magnitude.
    product_uses: HashMap<(Term, u64), usize, NodeHash>,
}

/// Two terms that rows have in common: up to sign, `weights.0 * a + weights.1 * b`, or, with both weights 1, any multiple of
/// `a + b` (`a - b` if `opposite`).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    a: Term,
    b: Term,
    weights: (u64, u64),
    opposite: bool,
}

const UNIT: u64 = 1.0_f64.to_bits();

impl Pair {
    fn new((a, weight_a): (Term, f64), (b, weight_b): (Term, f64)) -> Pair {
        let (magnitude_a, magnitude_b) = (weight_a.abs().to_bits(), weight_b.abs().to_bits());
        let weights = if magnitude_a == magnitude_b { (UNIT, UNIT) } else { (magnitude_a, magnitude_b) };
        Pair { a, b, weights, opposite: weight_a.is_sign_negative() != weight_b.is_sign_negative() }
    }

    fn row(self) -> Row {
        let sign = if self.opposite { -1.0 } else { 1.0 };
        vec![(self.a, f64::from_bits(self.weights.0)), (self.b, sign * f64::from_bits(self.weights.1))]
    }
}

impl Forms {
    /// Sums over terms below `terms`, each row sorted by term and without zero weights.
    pub fn new(rows: Vec<Row>, terms: Term) -> Forms {
        let asked = rows.len();
        let mut forms = Forms { rows, partial_terms: terms, asked, product_uses: HashMap::default() };
        for row in 0..asked {
            forms.count_products(row, 1);
        }
        forms
    }

    /// The row of a term that is a partial sum.
    pub fn partial(&self, term: Term) -> Option<usize> {
        (term >= self.partial_terms).then(|| self.asked + (term - self.partial_terms) as usize)
    }

    /// Makes partial sums as long as one saves operations, those that save most first.
    pub fn share_pairs(&mut self) {
        loop {
            let mut candidates = self.candidates();
            candidates.sort_by(|(gain, pair, _), (other_gain, other, _)| {
                other_gain.cmp(gain).then(pair.cmp(other))
            });
            let mut changed = false;
            for (gain, pair, mut rows) in candidates {
                // Earlier ones in this round may have taken its rows or products: then it waits for the next.
                rows.retain(|row| self.weight_of(*row, pair).is_some());
                if self.gain(pair, &rows) >= gain {
                    self.extract(pair, &rows);
                    changed = true;
                }
            }
            if !changed {
                return;
            }
        }
    }

    /// Every pair that would save operations, with its gain and rows.
    fn candidates(&self) -> Vec<(isize, Pair, Vec<usize>)> {
        let mut row_count: Vec<u32> = Vec::new();
        for (term, _) in self.rows.iter().flatten() {
            let term = *term as usize;
            row_count.resize(row_count.len().max(term + 1), 0);
            row_count[term] += 1;
        }
        let mut places = Vec::new();
        for (index, row) in self.rows.iter().enumerate() {
            for (k, first) in row.iter().enumerate() {
                for second in &row[k + 1..] {
                    let pair = Pair::new(*first, *second);
                    let may_recur = row_count[first.0 as usize] > 1 && row_count[second.0 as usize] > 1;
                    // In a single row a pair pays only by a weight in common.
                    if may_recur || (pair.weights == (UNIT, UNIT) && first.1.abs() != 1.0) {
                        places.push((pair, index));
                    }
                }
            }
        }
        places.sort_unstable();
        let groups = places.chunk_by(|(pair, _), (other, _)| pair == other);
        let candidates = groups.filter_map(|group| {
            let pair = group[0].0;
            if group.len() == 1
                && (pair.weights != (UNIT, UNIT) || self.weight_of(group[0].1, pair)?.abs() == 1.0)
            {
                return None;
            }
            let rows = group.iter().map(|(_, row)| *row).collect::<Vec<_>>();
            let gain = self.gain(pair, &rows);
            (gain > 0).then_some((gain, pair, rows))
        });
        candidates.collect()
    }

    /// Operations saved by computing `pair` once for `rows`.
    fn gain(&self, pair: Pair, rows: &[usize]) -> isize {
        let additions = rows.len() as isize - 1;
        if pair.weights != (UNIT, UNIT) {
            return additions;
        }
        let mut magnitudes: Vec<u64> = rows
            .iter()
            .filter_map(|row| self.weight_of(*row, pair))
            .map(|weight| weight.abs().to_bits())
            .collect();
        magnitudes.sort_unstable();
        let saved = magnitudes.chunk_by(u64::eq).filter(|group| group[0] != UNIT).map(|group| {
            let only_here = |term| term != ONE && self.product_uses[&(term, group[0])] == group.len();
            isize::from(only_here(pair.a)) + isize::from(only_here(pair.b)) - 1
        });
        additions + saved.sum::<isize>()
    }

    /// The weight of `pair` in a row that contains it.
    fn weight_of(&self, row: usize, pair: Pair) -> Option<f64> {
        let entry = |term: Term| {
            let row = &self.rows[row];
            row.binary_search_by_key(&term, |(term, _)| *term).ok().map(|position| row[position])
        };
        let (first, second) = (entry(pair.a)?, entry(pair.b)?);
        if Pair::new(first, second) != pair {
            return None;
        }
        Some(if pair.weights == (UNIT, UNIT) { first.1 } else { 1.0_f64.copysign(first.1) })
    }

    fn extract(&mut self, pair: Pair, rows: &[usize]) {
        let term = self.partial_terms + (self.rows.len() - self.asked) as Term;
        for &row in rows {
            let Some(weight) = self.weight_of(row, pair) else { continue };
            self.count_products(row, -1);
            self.rows[row].retain(|(term, _)| *term != pair.a && *term != pair.b);
            // New terms have the highest numbers: the row stays sorted.
            self.rows[row].push((term, weight));
            self.count_products(row, 1);
        }
        self.rows.push(pair.row());
        self.count_products(self.rows.len() - 1, 1);
    }

    fn count_products(&mut self, row: usize, change: isize) {
        for (term, weight) in &self.rows[row] {
            let uses = self.product_uses.entry((*term, weight.abs().to_bits())).or_default();
            *uses = uses.wrapping_add_signed(change);
        }
    }
}
