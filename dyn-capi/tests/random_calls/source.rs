//! Situations from ordinary to absurd.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::mem::size_of;
use std::path::Path;
use std::ptr::{null, null_mut};

use dyn_capi as capi;
use dyn_capi::{Coils, Inputs, Limits, Model, ModelKind, Real, Status, UhpParameters, UpsParameters};
use dyn_platform::Platform;
use dyn_runtime::nalgebra::{Matrix3, Rotation3, Vector3};
use dyn_runtime::{Pose, angles};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde_json::Value;

/// Numbers in the place of `struct_size`.
const HEADER: usize = size_of::<usize>() / size_of::<Real>();

/// A model, what its pointers point to, and a state.
pub struct Situation {
    pub model: Model,
    pub inputs: Inputs,
    /// For forward kinematics, m.
    pub lengths: [Real; 6],
    /// The model points to them.
    _parameters: Box<(UhpParameters, UpsParameters)>,
}

/// Random numbers.
pub struct Source {
    random: Pcg64,
    uhp: (UhpParameters, Pose),
    ups: (UpsParameters, Pose),
    /// How far the paper's platform may move along x from home before a leg is out of reach, m.
    edge: f64,
}

impl Source {
    pub fn new() -> Self {
        let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
        let (uhp, _) = example("uhp_2016");
        let ups = example("ups_regular");
        Self { random: Pcg64::seed_from_u64(11), uhp: (uhp, home), ups, edge: edge(&home) }
    }

    /// A number below `most`.
    pub fn one_of(&mut self, most: u32) -> u32 {
        self.random.random_range(0..most)
    }

    fn chance(&mut self, one_in: u32) -> bool {
        self.one_of(one_in) == 0
    }

    /// A pointer to a struct, rarely one that is refused.
    pub fn pointer<T>(&mut self, structure: &T) -> *const T {
        match self.one_of(300) {
            0 => null(),
            1 => (&raw const *structure).cast::<u8>().wrapping_add(1).cast(),
            _ => structure,
        }
    }

    /// A pointer to the first number, rarely one that is refused.
    pub fn first<const N: usize>(&mut self, numbers: &[Real; N]) -> *const Real {
        self.pointer(numbers).cast()
    }

    /// Mostly as they are, sometimes hugely scaled, rarely not finite.
    pub fn numbers<const N: usize>(&mut self, numbers: &[Real; N]) -> [Real; N] {
        let mut numbers = *numbers;
        if self.chance(150) {
            let factor = 10.0_f64.powi(self.random.random_range(-300..308)) as Real;
            numbers = numbers.map(|number| number * factor);
        }
        if self.chance(300) {
            let odd = [Real::NAN, Real::INFINITY, Real::NEG_INFINITY];
            numbers[self.random.random_range(0..N)] = odd[self.random.random_range(0..3)];
        }
        numbers
    }

    fn vector<const N: usize>(&mut self, size: f64) -> [Real; N] {
        let numbers = std::array::from_fn(|_| self.random.random_range(-size..size) as Real);
        self.numbers(&numbers)
    }

    pub fn three(&mut self, size: f64) -> [Real; 3] {
        self.vector(size)
    }

    pub fn six(&mut self, size: f64) -> [Real; 6] {
        self.vector(size)
    }

    /// Often near gimbal lock.
    pub fn angles(&mut self) -> [Real; 3] {
        let mut angles = self.three(TAU);
        if self.chance(4) {
            angles[1] = FRAC_PI_2 as Real;
        }
        angles
    }

    /// Mostly of norm 1.
    pub fn quaternion(&mut self) -> [Real; 4] {
        let quaternion: [f64; 4] = std::array::from_fn(|_| self.random.random_range(-1.0..1.0));
        let norm = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
        let norm = if self.chance(10) { 1.1 * norm } else { norm };
        self.numbers(&quaternion.map(|part| (part / norm) as Real))
    }

    /// Limits, some of them infinite, some that are none.
    pub fn limits(&mut self) -> Limits {
        let mut limits = Limits {
            struct_size: size_of::<Limits>(),
            minimum_length: [0.15; 6],
            maximum_length: [0.25; 6],
            maximum_velocity: [3.0; 6],
            maximum_force: [55.0; 6],
            maximum_hooke_joint_angle: [0.5; 6],
            maximum_platform_joint_angle: [[0.5, Real::INFINITY][self.random.random_range(0..2)]; 6],
            home_direction_in_base: [[0.0, 0.0, 1.0]; 6],
            home_direction_in_platform: [self.three(1.0); 6],
            minimum_condition_bound: 1e-3,
        };
        if self.chance(2) {
            limits.minimum_length = [Real::NEG_INFINITY; 6];
            limits.maximum_length = [Real::INFINITY; 6];
        }
        match self.one_of(40) {
            0 => limits.maximum_velocity[1] = Real::NAN,
            1 => limits.home_direction_in_base[4] = [0.0; 3],
            2 => limits.minimum_condition_bound = Real::NAN,
            _ => {}
        }
        self.size(&mut limits.struct_size);
        limits
    }

    /// Coils, some of them impossible.
    pub fn coils(&mut self) -> Coils {
        let mut coils = Coils {
            struct_size: size_of::<Coils>(),
            force_constant: [20.0; 6],
            maximum_current: [if self.chance(4) { Real::INFINITY } else { 2.0 }; 6],
        };
        if self.chance(20) {
            coils.force_constant[2] = [0.0, Real::NAN, 1e-30][self.random.random_range(0..3)];
        }
        self.size(&mut coils.struct_size);
        coils
    }

    /// Rarely a wrong size.
    fn size(&mut self, struct_size: &mut usize) {
        if self.chance(300) {
            *struct_size = self.random.random_range(0..2000);
        }
    }

    fn pose(&mut self, metres: f64, radians: f64) -> Pose {
        let (position, turn) = (double(self.three(metres)), double(self.three(radians)));
        let mut rotation = angles::rotation(turn);
        if self.chance(200) {
            let skew = Matrix3::new(1.0, 1e-2, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
            rotation = Rotation3::from_matrix_unchecked(rotation.matrix() * skew);
        }
        Pose { position_m: position.into(), rotation }
    }

    /// Any model with any parameters at any state.
    pub fn situation(&mut self) -> Situation {
        let kind = [ModelKind::Baked, ModelKind::Uhp, ModelKind::Ups][self.random.random_range(0..3)];
        let home = if kind == ModelKind::Ups { self.ups.1 } else { self.uhp.1 };
        let parameters = self.parameters();
        let mut model = Model {
            struct_size: size_of::<Model>(),
            kind: if self.chance(200) { self.random.random_range(3..9) } else { kind as i32 },
            uhp: self.pointer(&parameters.0),
            ups: self.pointer(&parameters.1),
        };
        self.size(&mut model.struct_size);

        // From near home to out of reach, and a hair's breadth from the edge.
        let reach = [0.002, 0.05, 0.3][self.random.random_range(0..3)];
        let mut relative = home.compose(&self.pose(reach, 3.0 * reach));
        if self.chance(10) {
            relative = home;
            relative.position_m.x += self.edge + 1e-6 * self.random.random_range(-1.0..0.2);
        }
        if self.chance(30) {
            // So far that all legs are one, where no reach ends.
            relative.position_m *= 10.0_f64.powi(self.random.random_range(1..150));
        }
        let base = self.pose(1.0, 1.0);
        let platform = base.compose(&relative);
        let mut inputs = Inputs {
            struct_size: size_of::<Inputs>(),
            base_position: position(&base),
            base_rotation: rotation(&base),
            base_velocity: self.six(2.0),
            base_acceleration: self.six(50.0),
            platform_position: position(&platform),
            platform_rotation: rotation(&platform),
            platform_velocity: self.six(2.0),
            platform_acceleration: self.six(50.0),
            reference_velocity: self.six(2.0),
            actuator_force: self.six(60.0),
            external_wrench: self.six(100.0),
        };
        self.size(&mut inputs.struct_size);
        // As long as the legs at home are, more or less.
        let length = if kind == ModelKind::Ups { 0.4 } else { 0.198 };
        let lengths = std::array::from_fn(|_| (length + self.random.random_range(-reach..reach)) as Real);
        Situation { model, inputs, lengths, _parameters: parameters }
    }

    /// Of a mechanism, or not.
    fn parameters(&mut self) -> Box<(UhpParameters, UpsParameters)> {
        let mut parameters = Box::new((self.uhp.0, self.ups.0));
        let (uhp, ups) = &mut *parameters;
        let leg = self.random.random_range(0..6);
        match self.one_of(30) {
            // Two legs are one.
            0 => {
                uhp.base_point[5] = uhp.base_point[4];
                uhp.platform_point[5] = uhp.platform_point[4];
                ups.base_point[5] = ups.base_point[4];
                ups.platform_point[5] = ups.platform_point[4];
            }
            1 => {
                uhp.rod_length[leg] = [0.0, Real::NAN][self.random.random_range(0..2)];
                ups.base_point[leg] = [Real::NAN; 3];
            }
            2 => {
                let mass = self.three(1.0)[0];
                uhp.payload_mass = mass;
                ups.payload_mass = mass;
            }
            3 => {
                let stiffness = self.six(1e300);
                uhp.axial_stiffness = stiffness;
                ups.axial_stiffness = stiffness;
            }
            _ => {}
        }
        self.size(&mut uhp.struct_size);
        self.size(&mut ups.struct_size);
        parameters
    }
}

/// In double precision, whatever that of the library.
fn double(numbers: [Real; 3]) -> [f64; 3] {
    #[allow(clippy::useless_conversion)] // Not where the library has single precision.
    numbers.map(f64::from)
}

fn position(pose: &Pose) -> [Real; 3] {
    let position: [f64; 3] = pose.position_m.into();
    position.map(|number| number as Real)
}

fn rotation(pose: &Pose) -> [[Real; 3]; 3] {
    let rows: [[f64; 3]; 3] = pose.rotation.matrix().transpose().into();
    rows.map(|row| row.map(|number| number as Real))
}

/// By bisection of what the library says.
fn edge(home: &Pose) -> f64 {
    let model =
        Model { struct_size: size_of::<Model>(), kind: ModelKind::Baked as i32, uhp: null(), ups: null() };
    let is_inside = |x: f64| {
        let mut inputs: Inputs = structure(&[0.0; 66]);
        inputs.base_rotation = rotation(&Pose::identity());
        inputs.platform_rotation = inputs.base_rotation;
        inputs.platform_position = position(home);
        inputs.platform_position[0] += x as Real;
        let mut alignment = [0.0; 6];
        // SAFETY: all live.
        let status = unsafe { capi::dyn_rod_alignment(&model, &inputs, &mut alignment, null_mut()) };
        assert_eq!(status, Status::Ok);
        alignment.iter().all(|alignment| *alignment > 0.0)
    };
    let (mut inside, mut outside) = (0.0, 0.3);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if is_inside(middle) { inside = middle } else { outside = middle }
    }
    inside
}

/// The parameters of a platform of the test vectors, and its pose in the first case, relative to the base.
fn example<T: Copy>(name: &str) -> (T, Pose) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../tests/vectors/{name}.json"));
    let text = std::fs::read_to_string(file).expect("vectors are committed");
    let vectors: Value = serde_json::from_str(&text).expect("they are JSON");
    let platform: Platform =
        serde_json::from_value(vectors["platform"].clone()).expect("they have a platform");
    let names = platform.parameter_names();
    let numbers: Vec<Real> = names
        .into_iter()
        .flat_map(|name| platform.parameter(name).expect("one of its parameters"))
        .map(|number| number as Real)
        .collect();
    let pose = |body: &str| {
        let body = &vectors["cases"][0][body];
        let position: [f64; 3] = serde_json::from_value(body["position"].clone()).expect("three numbers");
        let rows: [[f64; 3]; 3] = serde_json::from_value(body["rotation"].clone()).expect("nine numbers");
        let matrix = Matrix3::from(rows).transpose();
        Pose { position_m: position.into(), rotation: Rotation3::from_matrix_unchecked(matrix) }
    };
    let (base, platform) = (pose("base"), pose("platform"));
    let to_base = base.rotation.inverse();
    let relative = Pose {
        position_m: to_base * (platform.position_m - base.position_m),
        rotation: to_base * platform.rotation,
    };
    (structure(&numbers), relative)
}

/// A struct of the interface from the numbers after its size.
fn structure<T: Copy>(numbers: &[Real]) -> T {
    let mut words = vec![0_u64; size_of::<T>() / 8];
    words[0] = size_of::<T>() as u64;
    assert_eq!((HEADER + numbers.len()) * size_of::<Real>(), size_of::<T>());
    let start = words.as_mut_ptr();
    // SAFETY: as many bytes as the struct has, aligned for its `usize`; any bits are numbers.
    unsafe {
        start.add(1).cast::<Real>().copy_from_nonoverlapping(numbers.as_ptr(), numbers.len());
        start.cast::<T>().read()
    }
}
