//! Which legs stand side by side: the blocks of the linear system for the actuators' reactions are made of them.

use crate::graph::{Graph, SolveKind, solve_general};
use crate::passes::{Context, EVERY_OTHER, depends_on_parameters, sampled_matrices};

/// Legs in two times three lanes, and how the solve in blocks of them does over the sampled states.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Partition {
    /// Legs in the first three lanes and in the second three.
    pub legs: Vec<usize>,
    /// Largest error of the solution in blocks, over the error that rounding of the matrix alone would cause, at the worst
    /// state: the factor by which digits are lost to the fixed order. 0 if there is no general linear system.
    pub growth: f64,
    /// Number of states.
    pub states: usize,
    /// Whether the solution in blocks is an attempt, because parameters at run time reach the matrix.
    pub examined: bool,
}

impl Partition {
    /// The first legs beside each other, then the others; chosen by nothing.
    pub fn in_order(legs: usize) -> Self {
        Self { legs: (0..legs).collect(), growth: 0.0, states: 0, examined: false }
    }
}

/// Of the partitions whose first block stays far from singular, the one with the least growth. The legs in order if there is
/// none, or nothing to choose by: no system or no states; every other leg if parameters at run time reach the matrix.
pub fn choose(graph: &Graph, context: &Context, legs: usize) -> Partition {
    let in_order = Partition::in_order(legs);
    let system = graph.solves.iter().find(|solve| solve.kind == SolveKind::General);
    let Some(solve) = system.filter(|solve| solve.right_hand_side.len() == 6 && legs == 6) else {
        return in_order;
    };
    if depends_on_parameters(graph, solve, context) {
        return Partition { legs: EVERY_OTHER.to_vec(), examined: true, ..in_order };
    }
    let references: Vec<Reference> =
        sampled_matrices(graph, solve, context).iter().map(|matrix| Reference::new(matrix)).collect();
    let growth =
        |legs: &[usize]| references.iter().map(|reference| reference.growth(legs)).fold(0.0, f64::max);
    // Exchanging the halves is a choice of its own: the first block is inverted as it is.
    let candidates = (0..64_usize).filter(|set| set.count_ones() == 3).map(|set| {
        let (first, second): (Vec<_>, Vec<_>) = (0..6).partition(|leg| set >> leg & 1 == 1);
        let legs = [first, second].concat();
        Partition { growth: growth(&legs), legs, states: references.len(), examined: false }
    });
    candidates
        .filter(|partition| stays_regular(&references, &partition.legs))
        .min_by(|a, b| a.growth.total_cmp(&b.growth))
        .unwrap_or(in_order)
}

/// Least determinant of the first block, its columns scaled to length 1, over the largest one: at poses between the sampled
/// ones it may be less, and near 0 the blocks lose every digit, however well they do at those.
const LEAST_SHARE: f64 = 0.2;

/// Whether the determinant of the first block has one sign at all states, and is small at none.
fn stays_regular(references: &[Reference], legs: &[usize]) -> bool {
    let determinants = references.iter().map(|reference| {
        let columns: Block = std::array::from_fn(|j| std::array::from_fn(|i| reference.matrix[i][legs[j]]));
        let lengths: f64 = columns.iter().map(|column| dot(*column, *column).sqrt()).product();
        dot(columns[0], cofactors(columns)[0]) / lengths
    });
    let (least, most) = determinants
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), determinant| {
            (least.min(determinant), most.max(determinant))
        });
    least >= LEAST_SHARE * most && least > 0.0 || most <= LEAST_SHARE * least && most < 0.0
}

type Block = [[f64; 3]; 3];

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cofactors(a: Block) -> Block {
    std::array::from_fn(|i| cross(a[(i + 1) % 3], a[(i + 2) % 3]))
}

/// The solution as [`super::blocks`] writes it out.
fn solve_in_blocks(matrix: &[[f64; 6]; 6], right: &[f64; 6], legs: &[usize]) -> [f64; 6] {
    let block = |row: usize, column: usize| -> Block {
        std::array::from_fn(|i| std::array::from_fn(|j| matrix[row + i][legs[column + j]]))
    };
    let (a, b, c, d) = (block(0, 0), block(0, 3), block(3, 0), block(3, 3));
    let (first, second) = ([right[0], right[1], right[2]], [right[3], right[4], right[5]]);
    let cofactor = cofactors(a);
    let determinant = dot(a[0], cofactor[0]);
    let inner = |column: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| (0..3).map(|x| cofactor[x][i] * column[x]).sum())
    };
    let columns: Block = std::array::from_fn(|j| inner([b[0][j], b[1][j], b[2][j]]));
    let known = inner(first);
    let complement: Block =
        std::array::from_fn(|m| std::array::from_fn(|j| determinant * d[m][j] - dot(c[m], columns[j])));
    let rest: [f64; 3] = std::array::from_fn(|m| determinant * second[m] - dot(c[m], known));
    let cofactor = cofactors(complement);
    let reciprocal = 1.0 / dot(complement[0], cofactor[0]);
    let y: [f64; 3] =
        std::array::from_fn(|j| (0..3).map(|m| cofactor[m][j] * rest[m]).sum::<f64>() * reciprocal);
    let x: [f64; 3] =
        std::array::from_fn(|i| (known[i] - (0..3).map(|j| columns[j][i] * y[j]).sum::<f64>()) / determinant);
    let mut solution = [0.0; 6];
    x.iter().chain(&y).zip(legs).for_each(|(value, leg)| solution[*leg] = *value);
    solution
}

/// A right-hand side along each axis with what is known of its solution whatever the partition.
struct Reference {
    matrix: [[f64; 6]; 6],
    /// By pivoting.
    exact: [[f64; 6]; 6],
    /// What rounding of the matrix changes of it at most.
    allowed: [f64; 6],
}

impl Reference {
    /// `matrix` is 6 x 6, row-major.
    fn new(matrix: &[f64]) -> Reference {
        let matrix: [[f64; 6]; 6] =
            std::array::from_fn(|row| std::array::from_fn(|column| matrix[6 * row + column]));
        let solved = |right: [f64; 6]| {
            let mut solution = right;
            solve_general(&mut matrix.concat(), &mut solution, &mut Vec::new());
            solution
        };
        let exact: [[f64; 6]; 6] = std::array::from_fn(|axis| solved(along(axis)));
        let allowed = exact.map(|exact| {
            // A change of each entry by half a unit in the last place changes x by up to |A^-1| |A| |x| times that.
            let mut moved = [0.0; 6];
            for column in 0..6 {
                let unit = solved(std::array::from_fn(|row| matrix[row][column].abs() * exact[column].abs()));
                moved.iter_mut().zip(unit).for_each(|(sum, x)| *sum += x.abs());
            }
            moved.iter().chain(&exact).fold(0.0_f64, |most, x| most.max(x.abs())) * f64::EPSILON
        });
        Reference { matrix, exact, allowed }
    }

    /// How much worse than rounding of the matrix the solution is.
    fn growth(&self, legs: &[usize]) -> f64 {
        let mut worst = 0.0_f64;
        for axis in 0..6 {
            let x = solve_in_blocks(&self.matrix, &along(axis), legs);
            let errors = x.iter().zip(&self.exact[axis]).map(|(x, exact)| (x - exact).abs());
            let ratio = errors.fold(0.0_f64, f64::max) / self.allowed[axis];
            worst = if ratio.is_nan() { f64::INFINITY } else { worst.max(ratio) };
        }
        worst
    }
}

/// The unit vector along an axis.
fn along(axis: usize) -> [f64; 6] {
    std::array::from_fn(|row| f64::from(u8::from(row == axis)))
}
