//! Nothing here asks for memory: every checked call, every generated function of both models, every refusal.

// An allocator is unsafe by nature; this one counts and hands on to the system's.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::hint::black_box;

use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::{Parameters, Uhp, Uhp2016};
use dyn_runtime::nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, Input, Limits, Monitor, PlatformState, Pose, Quantity, Twist,
    Wrench, angles, kernels, solve,
};

struct Counting;

thread_local! {
    /// Requests of this thread; the test harness allocates in others.
    static REQUESTS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    // Not there any more while a thread ends.
    let _ = REQUESTS.try_with(|requests| requests.set(requests.get() + 1));
}

// SAFETY: every method hands on to `System` with the same arguments; counting does not allocate.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `alloc_zeroed`.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often `run` asks for memory.
fn requests(run: impl FnOnce()) -> usize {
    let before = REQUESTS.get();
    run();
    REQUESTS.get() - before
}

#[test]
fn the_counter_counts() {
    assert_eq!(requests(|| drop(black_box(Box::new(1.0)))), 1);
    assert_eq!(requests(|| drop(black_box(vec![0_u8; black_box(1000)]))), 1);
    let mut grown = black_box(vec![1.0]);
    assert_eq!(requests(|| grown.reserve_exact(black_box(1000))), 1);
    assert_eq!(requests(|| drop(black_box(Hexapod::new(Box::new(Uhp2016)).model))), 0, "no size, no memory");
    assert_eq!(requests(|| drop(black_box(Error::NonFiniteResult.to_string()))), 1);
}

/// The functions of a model, by the file that the generator wrote.
fn functions() -> Vec<&'static str> {
    let model = include_str!("../../src/generated/uhp.rs");
    let names =
        model.split("\npub fn ").skip(1).map(|text| text.split_once(['<', '(']).expect("a signature").0);
    // Methods choose between a function and the same in lanes; `prepared()` calls what prepares some.
    names.filter(|name| !name.ends_with("_in_lanes") && !name.starts_with("prepare_")).collect()
}

/// One trait that stands for those named.
macro_rules! all_of {
    ($($($kernel:ident)::+)*) => {
        trait Complete: $(kernels::$($kernel)::+ +)* {}
        impl<M: $(kernels::$($kernel)::+ +)*> Complete for M {}
    };
}

all_of! {
    RodAlignment LegKinematics uhp::BodyKinematics uhp::PartialVelocities uhp::GeneralisedForces JacobianDp JacobianDb
    MassMatrixP MassMatrixB CoriolisMatrices StiffnessMatrices Matrices PassiveForces Bias EquationOfMotion
    InverseDynamics ActuatorGeometry Control PassiveInverseDynamics BaseReaction ForwardDynamics Energy
}

#[derive(Clone, Copy)]
struct Arguments {
    base: BaseMotion,
    platform: PlatformState,
    platform_acceleration: Acceleration,
    actuator_force_n: Vector6<f64>,
    external_wrench: Wrench,
}

/// Near home, everything moving.
fn arguments() -> Arguments {
    let v = |x: f64| Vector3::new(x, -0.5 * x, 0.25 * x);
    let base_pose = Pose::from_paper_angles(v(1.0), [0.1, -0.2, 0.3]);
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.02, -0.01, 0.03]);
    Arguments {
        base: BaseMotion {
            pose: base_pose,
            velocity: Twist { linear_m_s: v(0.5), angular_rad_s: v(-0.4) },
            acceleration: Acceleration { linear_m_s2: v(3.0), angular_rad_s2: v(2.0) },
        },
        platform: PlatformState {
            pose: base_pose.compose(&home),
            velocity: Twist { linear_m_s: v(0.6), angular_rad_s: v(0.3) },
        },
        platform_acceleration: Acceleration { linear_m_s2: v(1.0), angular_rad_s2: v(4.0) },
        actuator_force_n: Vector6::repeat(20.0),
        external_wrench: Wrench { force_n: v(10.0), moment_n_m: v(1.0) },
    }
}

/// Every checked call of one function of the model, by that function's name, and its error if it has one.
fn checked_calls<M: Complete>(hexapod: &Hexapod<M>, a: &Arguments) -> [(&'static str, Option<Error>); 22] {
    fn error<T>(result: Result<T, Error>) -> Option<Error> {
        black_box(result).err()
    }
    let Arguments { base, platform, platform_acceleration, actuator_force_n, external_wrench } = a;
    let h = hexapod;
    [
        ("rod_alignment", error(h.rod_alignment(base, platform))),
        ("leg_kinematics", error(h.leg_kinematics(base, platform, platform_acceleration))),
        ("body_kinematics", error(h.body_kinematics(base, platform, platform_acceleration))),
        ("partial_velocities", error(h.partial_velocities(base, platform))),
        (
            "generalised_forces",
            error(h.generalised_forces(
                base,
                platform,
                platform_acceleration,
                actuator_force_n,
                external_wrench,
            )),
        ),
        ("jacobian_dp", error(h.jacobian_dp(base, platform))),
        ("jacobian_db", error(h.jacobian_db(base, platform))),
        ("mass_matrix_p", error(h.mass_matrix_p(base, platform))),
        ("mass_matrix_b", error(h.mass_matrix_b(base, platform))),
        ("coriolis_matrices", error(h.coriolis_matrices(base, platform))),
        ("stiffness_matrices", error(h.stiffness_matrices(base, platform))),
        ("matrices", error(h.matrices(base, platform))),
        ("passive_forces", error(h.passive_forces(base, platform))),
        ("bias", error(h.bias(base, platform))),
        ("equation_of_motion", error(h.equation_of_motion(base, platform))),
        (
            "inverse_dynamics",
            error(h.inverse_dynamics(base, platform, platform_acceleration, external_wrench)),
        ),
        (
            "actuator_geometry",
            error(h.forward_kinematics(
                &base.pose,
                &black_box(Vector6::new(0.19, 0.2, 0.2, 0.2, 0.2, 0.21)),
                &platform.pose,
            )),
        ),
        ("control", error(h.control(base, platform, platform_acceleration, external_wrench))),
        (
            "passive_inverse_dynamics",
            error(h.passive_inverse_dynamics(
                base,
                platform,
                &base.velocity,
                platform_acceleration,
                external_wrench,
            )),
        ),
        ("base_reaction", error(h.base_reaction(base, platform, platform_acceleration, external_wrench))),
        ("forward_dynamics", error(h.forward_dynamics(base, platform, actuator_force_n, external_wrench))),
        ("energy", error(h.energy(base, platform))),
    ]
}

/// Every checked call that computes something itself from what the model gives, and its error if it has one.
fn computed_calls<M: Complete>(hexapod: &Hexapod<M>, a: &Arguments) -> [(&'static str, Option<Error>); 4] {
    let limits =
        Limits { maximum_force_n: [50.0; 6], maximum_hooke_joint_angle_rad: [0.5; 6], ..Limits::none() };
    let monitor = black_box(hexapod.monitor(&a.base, &a.platform, &a.actuator_force_n, &limits));
    // A state beyond its limits is no error of monitors.
    let _ = black_box(monitor.as_ref().map(Monitor::check));
    let rates = black_box(Vector6::repeat(0.1));
    let velocity = black_box(hexapod.platform_velocity(&a.base, &a.platform.pose, &rates));
    let coils = black_box(VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [0.5; 6] });
    let currents = black_box(coils.currents(&a.actuator_force_n));
    let lost = black_box(Limits { maximum_force_n: [f64::NAN; 6], ..Limits::none() });
    let refused = black_box(hexapod.monitor(&a.base, &a.platform, &a.actuator_force_n, &lost));
    [
        ("monitor", monitor.err()),
        ("platform_velocity", velocity.err()),
        ("currents", currents.err()),
        ("monitor without limits", refused.ok().map(|_| Error::NonFiniteResult)),
    ]
}

/// Inputs as generated functions take them.
struct Arrays {
    base_position: [f64; 3],
    base_rotation: [[f64; 3]; 3],
    base_velocity: [f64; 6],
    base_acceleration: [f64; 6],
    platform_position: [f64; 3],
    platform_rotation: [[f64; 3]; 3],
    platform_velocity: [f64; 6],
    platform_acceleration: [f64; 6],
    actuator_force: [f64; 6],
    external_wrench: [f64; 6],
}

impl Arrays {
    fn new(a: &Arguments) -> Self {
        let rows = |rotation: &Rotation3<f64>| rotation.matrix().transpose().into();
        Self {
            base_position: a.base.pose.position_m.into(),
            base_rotation: rows(&a.base.pose.rotation),
            base_velocity: a.base.velocity.to_vector().into(),
            base_acceleration: a.base.acceleration.to_vector().into(),
            platform_position: a.platform.pose.position_m.into(),
            platform_rotation: rows(&a.platform.pose.rotation),
            platform_velocity: a.platform.velocity.to_vector().into(),
            platform_acceleration: a.platform_acceleration.to_vector().into(),
            actuator_force: a.actuator_force_n.into(),
            external_wrench: a.external_wrench.to_vector().into(),
        }
    }
}

/// `function(inputs) -> (outputs)` to a function that calls them all.
macro_rules! raw_calls {
    ($($function:ident($($input:ident),*) -> ($($output:ident),+);)*) => {
        const RAW_CALLS: &[&str] = &[$(stringify!($function)),*];

        fn raw_calls(model: &impl Complete, arrays: &Arrays) {$(
            $(let mut $output = Default::default();)+
            model.$function($(black_box(&arrays.$input),)* $(&mut $output),+);
            black_box(($(&$output,)+));
        )*}
    };
}

raw_calls! {
    rod_alignment(base_position, base_rotation, platform_position, platform_rotation) -> (o1);
    leg_kinematics(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration) -> (o1, o2, o3, o4, o5, o6, o7);
    body_kinematics(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration)
        -> (o1, o2, o3, o4, o5, o6, o7, o8, o9, o10, o11);
    partial_velocities(base_position, base_rotation, platform_position, platform_rotation)
        -> (o1, o2, o3, o4, o5);
    generalised_forces(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration, actuator_force, external_wrench)
        -> (o1, o2, o3, o4, o5, o6);
    jacobian_dp(base_position, base_rotation, platform_position, platform_rotation) -> (o1);
    jacobian_db(base_position, base_rotation, platform_position, platform_rotation) -> (o1);
    mass_matrix_p(base_position, base_rotation, platform_position, platform_rotation) -> (o1);
    mass_matrix_b(base_position, base_rotation, platform_position, platform_rotation) -> (o1);
    coriolis_matrices(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1, o2);
    stiffness_matrices(base_position, base_rotation, platform_position, platform_rotation) -> (o1, o2);
    matrices(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1, o2, o3, o4, o5, o6);
    passive_forces(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1, o2, o3);
    bias(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1);
    equation_of_motion(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1, o2, o3, o4, o5, o6, o7, o8, o9, o10, o11, o12);
    inverse_dynamics(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration, external_wrench) -> (o1);
    actuator_geometry(base_position, base_rotation, platform_position, platform_rotation) -> (o1, o2, o3);
    control(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration, external_wrench)
        -> (o1, o2, o3, o4, o5, o6);
    passive_inverse_dynamics(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration, base_velocity, external_wrench) -> (o1);
    base_reaction(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, platform_acceleration, external_wrench) -> (o1);
    forward_dynamics(base_position, base_rotation, base_velocity, base_acceleration, platform_position,
        platform_rotation, platform_velocity, actuator_force, external_wrench) -> (o1);
    energy(base_position, base_rotation, base_velocity, platform_position, platform_rotation,
        platform_velocity) -> (o1, o2);
}

/// A mechanism near the baked one: six rods crosswise between two circles.
fn at_run_time() -> Uhp {
    let circle = |radius: f64, half_angle: f64| -> [[f64; 3]; 6] {
        std::array::from_fn(|leg| {
            let side = if leg.is_multiple_of(2) { -half_angle } else { half_angle };
            let (sin, cos) = (TAU / 3.0 * (leg / 2) as f64 + side).sin_cos();
            [radius * cos, radius * sin, 0.0]
        })
    };
    let parameters = Parameters::from_fn(|name, values| match name {
        "base_point" => values.copy_from_slice(circle(0.18, 0.75).as_flattened()),
        "platform_point" => values.copy_from_slice(circle(0.12, 0.26).as_flattened()),
        "actuator_axis" => values.copy_from_slice([[0.0, 0.0, 1.0]; 6].as_flattened()),
        "rod_length" => values.fill(0.206),
        "payload_inertia" => values.copy_from_slice(&[0.02, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0, 0.03]),
        "gravity" => values.copy_from_slice(&[0.0, 0.0, -9.81]),
        _ => values.fill(0.1),
    });
    Uhp { parameters }
}

/// Checked and raw calls of one model, inside the workspace and far outside of what is sensible.
fn assert_no_requests(model: impl Complete) {
    let hexapod = Hexapod::new(model);
    let inside = arguments();
    let mut results = [("", None); 22];
    assert_eq!(requests(|| results = checked_calls(&hexapod, black_box(&inside))), 0);
    assert_eq!(results.map(|(name, _)| name).as_slice(), functions());
    assert!(results.iter().all(|(_, error)| error.is_none()), "{results:?}");
    let mut computed = [("", None); 4];
    assert_eq!(requests(|| computed = computed_calls(&hexapod, black_box(&inside))), 0);
    assert!(computed.iter().all(|(_, error)| error.is_none()), "{computed:?}");

    assert_eq!(RAW_CALLS, functions());
    let arrays = Arrays::new(&inside);
    assert_eq!(requests(|| raw_calls(&hexapod.model, black_box(&arrays))), 0);

    let mut outside = inside;
    outside.platform.pose.position_m.z += 10.0;
    let mut no_numbers = inside;
    no_numbers.base.pose.position_m.x = f64::NAN;
    let mut no_rotation = inside;
    no_rotation.platform.pose.rotation = Rotation3::from_matrix_unchecked(Matrix3::repeat(0.5));
    for bad in [outside, no_numbers, no_rotation] {
        assert_eq!(requests(|| results = checked_calls(&hexapod, black_box(&bad))), 0);
        assert_eq!(requests(|| computed = computed_calls(&hexapod, black_box(&bad))), 0);
        let arrays = Arrays::new(&bad);
        assert_eq!(requests(|| raw_calls(&hexapod.model, black_box(&arrays))), 0);
    }
    assert!(results.iter().all(|(_, error)| error.is_some()), "{results:?}");
    assert!(computed[..2].iter().all(|(_, error)| error.is_some()), "{computed:?}");
}

#[test]
fn the_baked_model_asks_for_no_memory() {
    assert_no_requests(Uhp2016);
}

#[test]
fn the_model_with_parameters_at_run_time_asks_for_no_memory() {
    assert_no_requests(at_run_time());
    assert_no_requests(at_run_time().prepared());
    assert_eq!(requests(|| _ = black_box(at_run_time().prepared())), 0);
    let filling = requests(|| {
        black_box(Parameters::from_fn(|_, values| values.fill(1.0)));
    });
    assert_eq!(filling, 0);
}

#[test]
fn states_angles_and_systems_ask_for_no_memory() {
    let at = Vector3::new(0.1, 0.2, 0.3);
    let w = Vector3::new(1.0, 2.0, 3.0);
    let count = requests(|| {
        let pose = black_box(Pose::from_paper_angles(at, black_box([0.1, 0.2, 0.3])));
        let _ = black_box(Pose::from_rotation_matrix(at, pose.rotation.matrix()));
        let _ = black_box(Pose::from_rotation_matrix(at, &Matrix3::zeros()));
        black_box(Pose::from_unit_quaternion(at, &UnitQuaternion::identity()).compose(&pose));
        let angles = black_box(angles::from_rotation(&pose.rotation));
        let _ = black_box(angles::angle_rates(angles, w));
        black_box(angles::angular_velocity(angles, [1.0; 3]));
        black_box(angles::angular_acceleration(angles, [1.0; 3], [2.0; 3]));
        let matrix = black_box([[4.0, 1.0, 0.5], [1.0, 3.0, 0.2], [0.5, 0.2, 2.0]]);
        black_box(solve::solve_general(&matrix, &[1.0, 2.0, 3.0]));
        black_box(solve::reciprocal_condition(&matrix));
    });
    assert_eq!(count, 0);
}

/// Text without a heap, as a controller would log it.
struct Line {
    bytes: [u8; 400],
    length: usize,
}

impl Write for Line {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        let end = self.length + text.len();
        self.bytes.get_mut(self.length..end).ok_or(std::fmt::Error)?.copy_from_slice(text.as_bytes());
        self.length = end;
        Ok(())
    }
}

#[test]
fn messages_ask_for_no_memory() {
    let defect = Pose::from_rotation_matrix(Vector3::zeros(), &Matrix3::<f64>::zeros()).expect_err("refused");
    let errors = [
        Error::NonFinite { input: Input::BaseVelocity, element: 5 },
        Error::NotARotation { input: Input::BaseRotation, defect },
        Error::InvalidModel { leg: 0 },
        Error::OutOfReach { leg: 1 },
        Error::RodPerpendicular { leg: 2 },
        Error::SingularJacobian { reciprocal_condition: 1e-9 },
        Error::NonFiniteResult,
        Error::InvalidLimit { quantity: Quantity::HookeJointAngle, leg: Some(3) },
        Error::InvalidCoil { leg: 4 },
    ];
    for error in errors {
        let mut line = Line { bytes: [0; 400], length: 0 };
        assert_eq!(requests(|| write!(line, "{error}").expect("long enough")), 0);
        assert!(line.length > 20);
    }
}
