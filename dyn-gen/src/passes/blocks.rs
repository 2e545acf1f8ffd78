//! Systems of six equations, written out in 3 x 3 blocks.
//!
//! With the matrix [A B; C D], the right-hand side [f; m], adj(A) = det(A) A^-1 and the unknowns [x; y]:
//!
//! ```text
//! K = adj(A) B           q = adj(A) f
//! S = det(A) D - C K     g = det(A) m - C q          so that S y = g
//! y = adj(S) g / det(S)  x = (q - K y) / det(A)
//! ```
//!
//! Two divisions, of which only one waits for everything else. Rows of blocks, and rows of adjugates as cross products of
//! them, are alike: groups tell so to whom puts them into lanes.

use crate::graph::{Builder, Group, NodeId, Op, Solve, SolveKind};

type Three = [NodeId; 3];

struct Blocks<'a> {
    builder: &'a mut Builder,
    groups: Vec<Group>,
}

impl Blocks<'_> {
    fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.builder.binary(Op::Mul, a, b)
    }

    fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.builder.binary(Op::Sub, a, b)
    }

    fn dot(&mut self, a: Three, b: Three) -> NodeId {
        let first = self.mul(a[0], b[0]);
        (1..3).fold(first, |sum, k| {
            let product = self.mul(a[k], b[k]);
            self.builder.binary(Op::Add, sum, product)
        })
    }

    /// `start - a . b`
    fn less(&mut self, start: NodeId, a: Three, b: Three) -> NodeId {
        (0..3).fold(start, |sum, k| {
            let product = self.mul(a[k], b[k]);
            self.sub(sum, product)
        })
    }

    fn group(&mut self, nodes: Three) -> Three {
        self.groups.push(Group::Array { shape: vec![3], nodes: nodes.to_vec() });
        nodes
    }

    fn cross(&mut self, a: Three, b: Three) -> Three {
        let entry = |blocks: &mut Self, i: usize| {
            let (plus, minus) =
                (blocks.mul(a[(i + 1) % 3], b[(i + 2) % 3]), blocks.mul(a[(i + 2) % 3], b[(i + 1) % 3]));
            blocks.sub(plus, minus)
        };
        let product = [entry(self, 0), entry(self, 1), entry(self, 2)];
        self.group(product)
    }

    fn reciprocal(&mut self, determinant: NodeId) -> NodeId {
        let one = self.builder.constant(1.0);
        self.builder.binary(Op::Div, one, determinant)
    }

    /// x = (q - K y) / det(A)
    fn first_half(&mut self, q: Three, k: [Three; 3], y: Three, reciprocal: NodeId) -> Three {
        let x = [0, 1, 2].map(|i| {
            let rest = self.less(q[i], k[i], y);
            self.mul(rest, reciprocal)
        });
        self.group(x)
    }

    /// Matrix times vector, beginning on the diagonal: so that each step of the sum takes one triple of the matrix.
    fn symmetric_times(&mut self, matrix: Symmetric, vector: Three) -> Three {
        [0, 1, 2].map(|i| {
            let order = [i, (i + 1) % 3, (i + 2) % 3];
            self.dot(order.map(|j| matrix.at(i, j)), order.map(|j| vector[j]))
        })
    }

    /// The adjugate, and the determinant.
    fn symmetric_adjugate(&mut self, matrix: Symmetric) -> (Symmetric, NodeId) {
        let Symmetric { diagonal: d, opposite: o } = matrix;
        let mut entries = |plus: [Three; 2], minus: [Three; 2]| {
            let entries = [0, 1, 2].map(|k: usize| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (plus, minus) = (self.mul(plus[0][i], plus[1][j]), self.mul(minus[0][k], minus[1][k]));
                self.sub(plus, minus)
            });
            self.group(entries)
        };
        let adjugate = Symmetric { diagonal: entries([d, d], [o, o]), opposite: entries([o, o], [o, d]) };
        let determinant = self.dot(matrix.row(0), adjugate.row(0));
        (adjugate, determinant)
    }

    /// Columns of the adjugate, and the determinant.
    fn adjugate(&mut self, rows: [Three; 3]) -> ([Three; 3], NodeId) {
        let columns = [0, 1, 2].map(|i| self.cross(rows[(i + 1) % 3], rows[(i + 2) % 3]));
        let determinant = self.dot(rows[0], columns[0]);
        (columns, determinant)
    }
}

fn transposed(rows: [Three; 3]) -> [Three; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j: usize| rows[j][i]))
}

/// Legs of hexapods in blocks: neighbours are often in one plane, every other leg seldom is.
pub(crate) const EVERY_OTHER: [usize; 6] = [0, 2, 4, 1, 3, 5];

/// The solution of a system that is solved in blocks as far as that does, and with pivots where it does not; what is alike.
pub(crate) fn attempted(
    builder: &mut Builder,
    mut system: Solve,
    order: &[usize],
) -> (Vec<NodeId>, Vec<Group>) {
    let groups;
    (system.attempt, groups) = in_blocks(builder, &system, order);
    let n = system.right_hand_side.len() as u32;
    let solve = builder.solve(system);
    ((0..n).map(|element| builder.solution(solve, element)).collect(), groups)
}

/// The solution, its unknowns in blocks in this order if the system is general, and what is alike in it.
pub(crate) fn in_blocks(builder: &mut Builder, system: &Solve, order: &[usize]) -> (Vec<NodeId>, Vec<Group>) {
    let mut blocks = Blocks { builder, groups: Vec::new() };
    let solution = match system.kind {
        SolveKind::General => general(&mut blocks, system, order),
        SolveKind::SymmetricPositiveDefinite => symmetric(&mut blocks, system),
    };
    (solution, blocks.groups)
}

/// The solution of a general system whose columns are taken in this order.
fn general(blocks: &mut Blocks, system: &Solve, order: &[usize]) -> Vec<NodeId> {
    let block = |row: usize, column: usize| {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j: usize| system.matrix[6 * (row + i) + order[column + j]]))
    };
    let (a, b, c, d) = (block(0, 0), block(0, 3), block(3, 0), block(3, 3));
    let right = |row: usize| [0, 1, 2].map(|i: usize| system.right_hand_side[row + i]);
    let (f, m) = (right(0), right(3));
    for rows in [a, b, c, d] {
        for row in rows {
            blocks.group(row);
        }
    }
    let (adjugate, determinant) = blocks.adjugate(a);
    let adjugate_rows = transposed(adjugate);
    let b_columns = transposed(b);
    let k = adjugate_rows.map(|row| {
        let entries = b_columns.map(|column| blocks.dot(row, column));
        blocks.group(entries)
    });
    let q = adjugate_rows.map(|row| blocks.dot(row, f));
    blocks.group(q);
    let k_columns = transposed(k);
    let s = [0, 1, 2].map(|i: usize| {
        let entries = [0, 1, 2].map(|j: usize| {
            let scaled = blocks.mul(determinant, d[i][j]);
            blocks.less(scaled, c[i], k_columns[j])
        });
        blocks.group(entries)
    });
    let g = [0, 1, 2].map(|i: usize| {
        let scaled = blocks.mul(determinant, m[i]);
        blocks.less(scaled, c[i], q)
    });
    blocks.group(g);
    let (s_adjugate, s_determinant) = blocks.adjugate(s);
    let [reciprocal, s_reciprocal] =
        [determinant, s_determinant].map(|determinant| blocks.reciprocal(determinant));
    let y = transposed(s_adjugate).map(|row| {
        let scaled = blocks.dot(row, g);
        blocks.mul(scaled, s_reciprocal)
    });
    blocks.group(y);
    let x = blocks.first_half(q, k, y, reciprocal);
    let mut solution = system.right_hand_side.clone();
    x.into_iter().chain(y).zip(order).for_each(|(value, place)| solution[*place] = value);
    solution
}

/// A symmetric 3 x 3 matrix: its diagonal, and the entry off the diagonal in the other two rows and columns.
#[derive(Clone, Copy)]
struct Symmetric {
    diagonal: Three,
    opposite: Three,
}

impl Symmetric {
    fn at(&self, row: usize, column: usize) -> NodeId {
        if row == column { self.diagonal[row] } else { self.opposite[3 - row - column] }
    }

    fn row(&self, row: usize) -> Three {
        [0, 1, 2].map(|column| self.at(row, column))
    }
}

/// Diagonal and opposite entries by the function of row and column, the smaller one first.
fn symmetric_by(mut entry: impl FnMut(usize, usize) -> NodeId) -> Symmetric {
    Symmetric {
        diagonal: [0, 1, 2].map(|k| entry(k, k)),
        opposite: [(1, 2), (0, 2), (0, 1)].map(|(i, j)| entry(i, j)),
    }
}

/// The triples in which the matrix of a symmetric system enters.
pub(crate) fn symmetric_triples(system: &Solve) -> [Three; 7] {
    let (a, b, d) = symmetric_blocks(system);
    [a.diagonal, a.opposite, b[0], b[1], b[2], d.diagonal, d.opposite]
}

/// The blocks of a symmetric matrix: A and D, and the rows of B = C^T.
fn symmetric_blocks(system: &Solve) -> (Symmetric, [Three; 3], Symmetric) {
    // Of symmetric systems the lower triangle counts.
    let at = |row: usize, column: usize| system.matrix[6 * row.max(column) + row.min(column)];
    let half = |start: usize| symmetric_by(|i, j| at(start + i, start + j));
    (half(0), [0, 1, 2].map(|i| [0, 1, 2].map(|j: usize| at(i, 3 + j))), half(3))
}

/// The solution of a symmetric system: A, S and their adjugates in two triples each.
fn symmetric(blocks: &mut Blocks, system: &Solve) -> Vec<NodeId> {
    let (a, b, d) = symmetric_blocks(system);
    let right = |row: usize| [0, 1, 2].map(|i: usize| system.right_hand_side[row + i]);
    let (f, m) = (right(0), right(3));
    let (adjugate, determinant) = blocks.symmetric_adjugate(a);
    let b_columns = transposed(b);
    let k = [0, 1, 2].map(|i| {
        let entries = b_columns.map(|column| blocks.dot(adjugate.row(i), column));
        blocks.group(entries)
    });
    let q = blocks.symmetric_times(adjugate, f);
    blocks.group(q);
    let k_columns = transposed(k);
    let s = symmetric_by(|i, j| {
        let scaled = blocks.mul(determinant, d.at(i, j));
        blocks.less(scaled, b_columns[i], k_columns[j])
    });
    blocks.group(s.diagonal);
    blocks.group(s.opposite);
    let g = [0, 1, 2].map(|i: usize| {
        let scaled = blocks.mul(determinant, m[i]);
        blocks.less(scaled, b_columns[i], q)
    });
    blocks.group(g);
    let (s_adjugate, s_determinant) = blocks.symmetric_adjugate(s);
    let [reciprocal, s_reciprocal] =
        [determinant, s_determinant].map(|determinant| blocks.reciprocal(determinant));
    let y = blocks.symmetric_times(s_adjugate, g).map(|scaled| blocks.mul(scaled, s_reciprocal));
    blocks.group(y);
    let x = blocks.first_half(q, k, y, reciprocal);
    x.into_iter().chain(y).collect()
}
