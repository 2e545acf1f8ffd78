//! The order in which a general linear system is eliminated when nothing can pivot at run time.

/// An order of pivots for one linear system, and how it does over the sampled states.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct PivotOrder {
    /// Name of the solution.
    pub solve: String,
    /// Row of each pivot, first to last.
    pub rows: Vec<usize>,
    /// Column of each pivot.
    pub columns: Vec<usize>,
    /// Largest entry of |L| |U| over the largest of |A|, after row and column scaling, at the worst state: the factor by which
    /// rounding errors of the factorisation exceed those of a stable one. Infinite where a pivot vanishes.
    pub growth: f64,
    /// The same for complete pivoting at each state, the least one can hope for.
    pub growth_of_complete_pivoting: f64,
    /// Number of states.
    pub states: usize,
}

/// Partial orders kept at each step of the search.
const BEAM: usize = 12;
/// Orders within this factor of the least growth compete by their number of operations.
const TOLERATED_GROWTH: f64 = 2.0;

/// What an entry is known to be without numbers.
#[derive(Clone, Copy, PartialEq)]
enum Entry {
    Zero,
    One,
    Value,
}

/// The remains of the matrices after some pivots.
#[derive(Clone)]
struct Partial {
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// The part of each sampled matrix still to be eliminated.
    remaining: Vec<Vec<f64>>,
    /// |L| |U| so far.
    accumulated: Vec<Vec<f64>>,
    pattern: Vec<Entry>,
    growth: f64,
    operations: usize,
}

impl Partial {
    fn free(&self, n: usize) -> (Vec<usize>, Vec<usize>) {
        let free = |used: &[usize]| (0..n).filter(|k| !used.contains(k)).collect();
        (free(&self.rows), free(&self.columns))
    }

    /// Growth after one more pivot, without doing it.
    fn growth_with(&self, n: usize, row: usize, column: usize) -> f64 {
        let (rows, columns) = self.free(n);
        let mut growth = self.growth;
        for (matrix, accumulated) in self.remaining.iter().zip(&self.accumulated) {
            let pivot = matrix[row * n + column].abs();
            if pivot == 0.0 {
                return f64::INFINITY;
            }
            for &i in &rows {
                let factor = if i == row { 1.0 } else { matrix[i * n + column].abs() / pivot };
                for &j in &columns {
                    let sum = accumulated[i * n + j] + factor * matrix[row * n + j].abs();
                    // NaN comes from numbers out of range, the worst of all.
                    if sum > growth || sum.is_nan() {
                        growth = if sum.is_nan() { f64::INFINITY } else { sum };
                    }
                }
            }
        }
        growth
    }

    fn eliminate(&mut self, n: usize, row: usize, column: usize, growth: f64) {
        let (rows, columns) = self.free(n);
        for (matrix, accumulated) in self.remaining.iter_mut().zip(&mut self.accumulated) {
            for &i in &rows {
                let factor = if i == row { 1.0 } else { matrix[i * n + column] / matrix[row * n + column] };
                for &j in &columns {
                    accumulated[i * n + j] += (factor * matrix[row * n + j]).abs();
                    if i != row {
                        matrix[i * n + j] -= factor * matrix[row * n + j];
                    }
                }
            }
        }
        let pivot = self.pattern[row * n + column];
        self.operations += usize::from(pivot != Entry::One);
        for &i in rows.iter().filter(|i| **i != row) {
            let factor = match (self.pattern[i * n + column], pivot) {
                (Entry::Zero, _) => continue,
                (factor, Entry::One) => factor,
                _ => Entry::Value,
            };
            self.operations += usize::from(pivot != Entry::One) + 2;
            for &j in columns.iter().filter(|j| **j != column) {
                let change = self.pattern[row * n + j];
                if change != Entry::Zero {
                    self.operations += usize::from(self.pattern[i * n + j] != Entry::Zero);
                    self.operations += usize::from(factor != Entry::One && change != Entry::One);
                    self.pattern[i * n + j] = Entry::Value;
                }
            }
        }
        self.rows.push(row);
        self.columns.push(column);
        self.growth = growth;
    }
}

/// The order of least growth over `matrices` (n x n each) that a beam search finds; among orders of about the same growth the
/// one with the fewest operations. `constant(row, column)` is the entry's value if it is the same at all states. None without
/// matrices to judge by. Growth is infinite where a matrix is singular: a zero pivot, a zero row or column, no numbers.
pub fn choose_order(
    solve: &str,
    n: usize,
    matrices: &[Vec<f64>],
    constant: &dyn Fn(usize, usize) -> Option<f64>,
) -> Option<PivotOrder> {
    let states = matrices.len();
    if states == 0 {
        return None;
    }
    let Some(scaled) = matrices.iter().map(|matrix| equilibrated(matrix, n)).collect::<Option<Vec<_>>>()
    else {
        return Some(PivotOrder {
            solve: solve.to_owned(),
            rows: (0..n).collect(),
            columns: (0..n).collect(),
            growth: f64::INFINITY,
            growth_of_complete_pivoting: f64::INFINITY,
            states,
        });
    };
    let entry = |k: usize| match constant(k / n, k % n) {
        Some(0.0) => Entry::Zero,
        Some(value) if value.abs() == 1.0 => Entry::One,
        _ => Entry::Value,
    };
    let start = Partial {
        rows: Vec::new(),
        columns: Vec::new(),
        accumulated: vec![vec![0.0; n * n]; scaled.len()],
        pattern: (0..n * n).map(entry).collect(),
        growth: 1.0,
        operations: 0,
        remaining: scaled,
    };
    let growth_of_complete_pivoting =
        start.remaining.iter().map(|matrix| complete_pivoting(matrix, n)).fold(1.0, f64::max);
    let mut beam = vec![start];
    for _ in 0..n {
        beam = step(&beam, n);
    }
    let least = beam[0].growth;
    let chosen = beam.iter().filter(|partial| partial.growth <= TOLERATED_GROWTH * least);
    let chosen = chosen.min_by(|a, b| a.operations.cmp(&b.operations).then(a.growth.total_cmp(&b.growth)));
    let Partial { rows, columns, growth, .. } = chosen.unwrap_or(&beam[0]).clone();
    Some(PivotOrder { solve: solve.to_owned(), rows, columns, growth, growth_of_complete_pivoting, states })
}

/// The best partial orders with one more pivot, by growth.
fn step(beam: &[Partial], n: usize) -> Vec<Partial> {
    let mut candidates: Vec<(f64, usize, usize, usize)> = Vec::new();
    for (index, partial) in beam.iter().enumerate() {
        let (rows, columns) = partial.free(n);
        for &row in &rows {
            for &column in &columns {
                candidates.push((partial.growth_with(n, row, column), index, row, column));
            }
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2, a.3).cmp(&(b.1, b.2, b.3))));
    let mut next: Vec<Partial> = Vec::new();
    for (growth, index, row, column) in candidates {
        // The same rows and columns in another order leave the same remainder.
        let mut partial = beam[index].clone();
        partial.eliminate(n, row, column, growth);
        let same_set = |other: &Partial| {
            sorted(&other.rows) == sorted(&partial.rows) && sorted(&other.columns) == sorted(&partial.columns)
        };
        if !next.iter().any(|other| same_set(other) && other.operations <= partial.operations) {
            next.push(partial);
        }
        if next.len() == BEAM {
            break;
        }
    }
    next
}

fn sorted(indices: &[usize]) -> Vec<usize> {
    let mut indices = indices.to_vec();
    indices.sort_unstable();
    indices
}

/// The matrix with rows and then columns scaled to largest entry 1, so that units do not matter; none if a row or column is
/// zero or not finite.
fn equilibrated(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let mut scaled = matrix.to_vec();
    for along_rows in [true, false] {
        for i in 0..n {
            let at = |j: usize| if along_rows { i * n + j } else { j * n + i };
            let largest = (0..n).fold(0.0_f64, |largest, j| largest.max(scaled[at(j)].abs()));
            if !(largest > 0.0 && largest.is_finite()) {
                return None;
            }
            (0..n).for_each(|j| scaled[at(j)] /= largest);
        }
    }
    scaled.iter().all(|value| value.is_finite()).then_some(scaled)
}

/// Growth of one scaled matrix with complete pivoting.
fn complete_pivoting(matrix: &[f64], n: usize) -> f64 {
    let mut partial = Partial {
        rows: Vec::new(),
        columns: Vec::new(),
        remaining: vec![matrix.to_vec()],
        accumulated: vec![vec![0.0; n * n]],
        pattern: vec![Entry::Value; n * n],
        growth: 1.0,
        operations: 0,
    };
    for _ in 0..n {
        let (rows, columns) = partial.free(n);
        let pairs = rows.iter().flat_map(|row| columns.iter().map(move |column| (*row, *column)));
        let size = |(row, column): &(usize, usize)| partial.remaining[0][row * n + column].abs();
        let Some((row, column)) = pairs.max_by(|a, b| size(a).total_cmp(&size(b))) else { break };
        let growth = partial.growth_with(n, row, column);
        partial.eliminate(n, row, column, growth);
    }
    partial.growth
}
