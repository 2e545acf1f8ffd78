//! The table of operations: the only place that says which arithmetic a graph may hold.

/// An operation on one to three operands.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Op {
    /// `-a`
    Neg,
    /// `sqrt(a)`, correctly rounded
    Sqrt,
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`
    Mul,
    /// `a / b`
    Div,
    /// `a * b + c`, rounded once where the machine can
    MulAdd,
    /// `a * b - c`, rounded once where the machine can
    MulSub,
    /// `c - a * b`, rounded once where the machine can
    NegMulAdd,
}

/// How products within sums are rounded.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Rounding {
    /// The product and then the sum, as on machines without fused multiply-add.
    #[default]
    Separate,
    /// Only the sum, as by a fused multiply-add.
    Fused,
}

/// What the generator knows of an operation.
pub struct OpInfo {
    /// The operation.
    pub op: Op,
    /// Its name in the graph file.
    pub name: &'static str,
    /// Number of operands.
    pub arity: usize,
    /// Whether exchanging the first two operands leaves every bit of the result as it is.
    pub commutative: bool,
    /// Counted as one operation in reports (negations ride along with additions and are not).
    pub counted: bool,
}

/// Every operation.
pub const OPS: [OpInfo; 9] = [
    OpInfo { op: Op::Neg, name: "neg", arity: 1, commutative: false, counted: false },
    OpInfo { op: Op::Sqrt, name: "sqrt", arity: 1, commutative: false, counted: true },
    OpInfo { op: Op::Add, name: "add", arity: 2, commutative: true, counted: true },
    OpInfo { op: Op::Sub, name: "sub", arity: 2, commutative: false, counted: true },
    OpInfo { op: Op::Mul, name: "mul", arity: 2, commutative: true, counted: true },
    OpInfo { op: Op::Div, name: "div", arity: 2, commutative: false, counted: true },
    OpInfo { op: Op::MulAdd, name: "mul_add", arity: 3, commutative: true, counted: true },
    OpInfo { op: Op::MulSub, name: "mul_sub", arity: 3, commutative: true, counted: true },
    OpInfo { op: Op::NegMulAdd, name: "neg_mul_add", arity: 3, commutative: true, counted: true },
];

impl Op {
    /// The row of [`OPS`] for this operation.
    pub fn info(self) -> &'static OpInfo {
        &OPS[self as usize]
    }

    /// The operation called `name` in a graph file.
    pub fn from_name(name: &str) -> Option<Op> {
        OPS.iter().find(|info| info.name == name).map(|info| info.op)
    }

    /// The value for operands `a`, `b` and `c` (as many as the operation has count), in IEEE 754 double precision.
    pub fn apply(self, rounding: Rounding, a: f64, b: f64, c: f64) -> f64 {
        let multiply_add = |a: f64, b: f64, c: f64| match rounding {
            Rounding::Separate => a * b + c,
            Rounding::Fused => a.mul_add(b, c),
        };
        match self {
            Op::Neg => -a,
            Op::Sqrt => a.sqrt(),
            Op::Add => a + b,
            Op::Sub => a - b,
            Op::Mul => a * b,
            Op::Div => a / b,
            Op::MulAdd => multiply_add(a, b, c),
            Op::MulSub => multiply_add(a, b, -c),
            Op::NegMulAdd => multiply_add(-a, b, c),
        }
    }
}
