//! Random calls of everything checked, far beyond what is sensible: no panic, no result that is not finite, no
//! answer that is not one of the call's own, and every kind of answer seen often.
//!
//! `RANDOM_CALLS=100000000 cargo test --release -p dyn-runtime --test random_calls` is the long run.

use std::collections::{BTreeMap, BTreeSet};

use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::Uhp2016;
use dyn_runtime::nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use dyn_runtime::{
    Acceleration, BaseMotion, Error, Hexapod, Limits, PlatformState, Pose, Twist, Wrench, kernels,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Calls of a run unless `RANDOM_CALLS` says otherwise.
const CALLS: u64 = 1_000_000;

/// The paper's platform, and layouts that it is not: legs that are no mechanism, a Jacobian that is singular.
#[derive(Clone, Copy)]
enum Layout {
    Paper,
    Singular,
    Broken,
}

struct Model(Layout);

/// Passes calls on to the paper's platform.
macro_rules! as_in_the_paper {
    ($($kernel:ident $function:ident($($input:ident: $in:ty),*) -> ($($output:ident: $out:ty),*);)*) => {$(
        impl kernels::$kernel for Model {
            fn $function(&self, $($input: &$in,)* $($output: &mut $out),*) {
                kernels::$kernel::$function(&Uhp2016, $($input,)* $($output),*);
            }
        }
    )*};
}

type V3 = [f64; 3];
type V6 = [f64; 6];
type M3 = [[f64; 3]; 3];
type M6 = [[f64; 6]; 6];

as_in_the_paper! {
    JacobianDb jacobian_db(i1: V3, i2: M3, i3: V3, i4: M3) -> (o1: M6);
    LegKinematics leg_kinematics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6)
        -> (o1: V6, o2: V6, o3: V6, o4: [V3; 6], o5: [V3; 6], o6: [V3; 6], o7: [V3; 6]);
    InverseDynamics inverse_dynamics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    PassiveInverseDynamics passive_inverse_dynamics(
        i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6, i10: V6
    ) -> (o1: V6);
    ForwardDynamics forward_dynamics(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    BaseReaction base_reaction(i1: V3, i2: M3, i3: V6, i4: V6, i5: V3, i6: M3, i7: V6, i8: V6, i9: V6)
        -> (o1: V6);
    EquationOfMotion equation_of_motion(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6)
        -> (o1: M6, o2: M6, o3: M6, o4: M6, o5: M6, o6: M6, o7: M6, o8: M6, o9: V6, o10: V6, o11: V6, o12: V6);
    Energy energy(i1: V3, i2: M3, i3: V6, i4: V3, i5: M3, i6: V6) -> (o1: f64, o2: f64);
}

impl Model {
    fn spoil(&self, jacobian: &mut M6) {
        if matches!(self.0, Layout::Singular) {
            jacobian[5] = jacobian[4];
        }
    }
}

impl kernels::RodAlignment for Model {
    fn rod_alignment(&self, rb: &V3, b: &M3, rp: &V3, p: &M3, alignment: &mut V6) {
        kernels::RodAlignment::rod_alignment(&Uhp2016, rb, b, rp, p, alignment);
        if matches!(self.0, Layout::Broken) {
            alignment[2] = f64::NAN;
        }
    }
}

impl kernels::JacobianDp for Model {
    fn jacobian_dp(&self, rb: &V3, b: &M3, rp: &V3, p: &M3, jacobian: &mut M6) {
        kernels::JacobianDp::jacobian_dp(&Uhp2016, rb, b, rp, p, jacobian);
        self.spoil(jacobian);
    }
}

impl kernels::ActuatorGeometry for Model {
    fn actuator_geometry(
        &self,
        rb: &V3,
        b: &M3,
        rp: &V3,
        p: &M3,
        alignment: &mut V6,
        d: &mut V6,
        jacobian: &mut M6,
    ) {
        kernels::ActuatorGeometry::actuator_geometry(&Uhp2016, rb, b, rp, p, alignment, d, jacobian);
        self.spoil(jacobian);
        if matches!(self.0, Layout::Broken) {
            alignment[2] = f64::NAN;
        }
    }
}

impl kernels::Control for Model {
    fn control(
        &self,
        rb: &V3,
        b: &M3,
        vb: &V6,
        ab: &V6,
        rp: &V3,
        p: &M3,
        vp: &V6,
        ap: &V6,
        w: &V6,
        d: &mut V6,
        rates: &mut V6,
        jacobian: &mut M6,
        mass: &mut M6,
        bias: &mut V6,
        forces: &mut V6,
    ) {
        kernels::Control::control(
            &Uhp2016, rb, b, vb, ab, rp, p, vp, ap, w, d, rates, jacobian, mass, bias, forces,
        );
        self.spoil(jacobian);
    }
}

/// Random numbers of every size, now and then none.
struct Source(Pcg64);

impl Source {
    fn chance(&mut self, one_in: u32) -> bool {
        self.0.random_range(0..one_in) == 0
    }

    /// Mostly of the given size, sometimes hugely scaled, rarely not finite.
    fn vector(&mut self, size: f64) -> Vector3<f64> {
        let mut vector = Vector3::from_fn(|_, _| self.0.random_range(-size..size));
        if self.chance(150) {
            vector *= 10.0_f64.powi(self.0.random_range(-300..300));
        }
        if self.chance(300) {
            vector[self.0.random_range(0..3)] =
                [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][self.0.random_range(0..3)];
        }
        vector
    }

    fn six(&mut self, size: f64) -> Vector6<f64> {
        let (upper, lower) = (self.vector(size), self.vector(size));
        Vector6::new(upper.x, upper.y, upper.z, lower.x, lower.y, lower.z)
    }

    fn pose(&mut self, metres: f64, radians: f64) -> Pose {
        let mut pose = Pose::from_paper_angles(self.vector(metres), self.vector(radians).into());
        if self.chance(200) {
            let skewed = pose.rotation.matrix() * Matrix3::new(1.0, 1e-3, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
            pose.rotation = Rotation3::from_matrix_unchecked(skewed);
        }
        pose
    }

    fn twist(&mut self) -> Twist {
        Twist { linear_m_s: self.vector(2.0), angular_rad_s: self.vector(5.0) }
    }

    fn acceleration(&mut self) -> Acceleration {
        Acceleration { linear_m_s2: self.vector(50.0), angular_rad_s2: self.vector(100.0) }
    }
}

/// What kind of answer it is.
fn kind<T>(answer: &Result<T, Error>) -> &'static str {
    match answer {
        Ok(_) => "ok",
        Err(Error::NonFinite { .. }) => "non-finite input",
        Err(Error::NotARotation { .. }) => "not a rotation",
        Err(Error::InvalidModel { .. }) => "invalid model",
        Err(Error::OutOfReach { .. }) => "out of reach",
        Err(Error::RodPerpendicular { .. }) => "rod perpendicular",
        Err(Error::SingularJacobian { .. }) => "singular Jacobian",
        Err(Error::NoConvergence { .. }) => "no convergence",
        Err(Error::BeyondLimit { .. }) => "beyond a limit",
        Err(Error::InvalidLimit { .. }) => "invalid limit",
        Err(Error::InvalidCoil { .. }) => "invalid coil",
        Err(Error::NonFiniteResult) => "non-finite result",
        Err(other) => panic!("a new kind of answer: {other}"),
    }
}

/// What each call may answer besides "non-finite result"; every one of these is seen.
fn kinds(call: &str) -> Vec<&'static str> {
    let at_poses =
        ["ok", "non-finite input", "not a rotation", "invalid model", "out of reach", "rod perpendicular"];
    match call {
        "inverse" | "control" | "passive" | "velocity" => [&at_poses[..], &["singular Jacobian"]].concat(),
        "pose" => [&at_poses[..], &["singular Jacobian", "no convergence"]].concat(),
        "monitor" => [&at_poses[..], &["invalid limit"]].concat(),
        "limits" => vec!["ok", "beyond a limit"],
        "currents" => vec!["ok", "non-finite input", "invalid coil"],
        _ => at_poses.to_vec(),
    }
}

const KINDS: usize = 12;

#[derive(Default)]
struct Seen {
    calls: u64,
    kinds: BTreeMap<&'static str, u64>,
    by_call: BTreeMap<(&'static str, &'static str), u64>,
    saturated: u64,
}

impl Seen {
    /// Counts the answer, which must be one that the call has; a result must be finite.
    fn add<T>(
        &mut self,
        call: &'static str,
        answer: Result<T, Error>,
        is_finite: impl Fn(&T) -> bool,
    ) -> Option<T> {
        let kind = kind(&answer);
        assert!(kind == "non-finite result" || kinds(call).contains(&kind), "{call}: {kind}");
        self.calls += 1;
        *self.kinds.entry(kind).or_default() += 1;
        *self.by_call.entry((call, kind)).or_default() += 1;
        if let Ok(result) = &answer {
            assert!(is_finite(result), "{call}: a result that is not finite, with Ok");
        }
        answer.ok()
    }
}

fn finite6(vector: &Vector6<f64>) -> bool {
    vector.iter().all(|x| x.is_finite())
}

fn finite66(matrix: &Matrix6<f64>) -> bool {
    matrix.iter().all(|x| x.is_finite())
}

fn calls(seen: &mut Seen, source: &mut Source) {
    let layout = match source.0.random_range(0..40) {
        0 => Layout::Singular,
        1 => Layout::Broken,
        _ => Layout::Paper,
    };
    let hexapod = Hexapod::new(Model(layout));
    let home = Pose::from_paper_angles(Vector3::new(0.0, 0.0, 0.382), [0.0; 3]);
    // From near home to out of reach, and a hair's breadth from the edge.
    let reach = [0.005, 0.05, 0.3][source.0.random_range(0..3)];
    let mut relative = source.pose(reach, 3.0 * reach);
    relative.position_m += home.position_m;
    if source.chance(20) {
        // Leg 1 leans over its edge at 0.113 m along x; rods there are perpendicular to their actuators.
        relative = home;
        relative.position_m.x += edge() + 1e-6 * source.0.random_range(-1.0..0.2);
    }
    let base = BaseMotion {
        pose: source.pose(1.0, 1.0),
        velocity: source.twist(),
        acceleration: source.acceleration(),
    };
    let platform = PlatformState { pose: base.pose.compose(&relative), velocity: source.twist() };
    let (acceleration, reference) = (source.acceleration(), source.twist());
    let wrench = Wrench { force_n: source.vector(100.0), moment_n_m: source.vector(10.0) };
    let forces = source.six(60.0);

    seen.add("inverse", hexapod.inverse_dynamics(&base, &platform, &acceleration, &wrench), finite6);
    seen.add("forward", hexapod.forward_dynamics(&base, &platform, &forces, &wrench), |a| {
        finite6(&a.to_vector())
    });
    seen.add("control", hexapod.control(&base, &platform, &acceleration, &wrench), |c| {
        [c.actuator_length_m, c.actuator_velocity_m_s, c.total_bias, c.inverse_dynamics_n].iter().all(finite6)
            && finite66(&c.jacobian_dp)
            && finite66(&c.mass_matrix_p)
    });
    let passive = hexapod.passive_inverse_dynamics(&base, &platform, &reference, &acceleration, &wrench);
    seen.add("passive", passive, finite6);
    seen.add("base", hexapod.base_reaction(&base, &platform, &acceleration, &wrench), |r| {
        r.force_n.iter().chain(&r.moment_n_m).all(|x| x.is_finite())
    });
    seen.add("energy", hexapod.energy(&base, &platform), |e| {
        e.kinetic_j.is_finite() && e.potential_j.is_finite()
    });
    seen.add("equation", hexapod.equation_of_motion(&base, &platform), |e| {
        finite66(&e.mass_matrix_p) && finite66(&e.coriolis_matrix_b) && finite6(&e.bias)
    });
    let mut limits = Limits {
        minimum_length_m: [0.15; 6],
        maximum_length_m: [0.25; 6],
        maximum_velocity_m_s: [3.0; 6],
        maximum_force_n: [55.0; 6],
        ..Limits::none()
    };
    if source.chance(20) {
        limits.maximum_length_m[3] = f64::NAN;
    }
    let monitor = seen.add("monitor", hexapod.monitor(&base, &platform, &forces, &limits), |monitor| {
        monitor.margins.iter().all(|margin| !margin.margin.is_nan())
    });
    if let Some(monitor) = monitor {
        seen.add("limits", monitor.check(), |()| true);
    }
    let mut coils = VoiceCoils { force_constant_n_per_a: [20.0; 6], maximum_current_a: [2.0; 6] };
    if source.chance(20) {
        coils.force_constant_n_per_a[2] = 0.0;
    }
    let currents = seen.add("currents", coils.currents(&forces), |c| {
        finite6(&c.current_a) && finite6(&c.actuator_force_n) && c.current_a.amax() <= 2.0
    });
    seen.saturated += u64::from(currents.is_some_and(|currents| currents.saturation.is_some()));
    seen.add("velocity", hexapod.platform_velocity(&base, &platform.pose, &forces), |v| {
        finite6(&v.to_vector())
    });
    let lengths = Vector6::repeat(0.198) + source.six(reach);
    let start = if source.chance(2) { platform.pose } else { base.pose.compose(&home) };
    seen.add("pose", hexapod.forward_kinematics(&base.pose, &lengths, &start), |found| {
        found.residual_m <= 1e-12 && found.pose.rotation.matrix().iter().all(|x| x.is_finite())
    });
}

/// How far the platform may move along x from home before a leg is out of reach, m.
fn edge() -> f64 {
    let alignment = |x: f64| {
        let platform = Pose::from_paper_angles(Vector3::new(x, 0.0, 0.382), [0.0; 3]);
        let (base, platform) = (BaseMotion::at_rest(Pose::identity()), PlatformState::at_rest(platform));
        Hexapod::new(Uhp2016).rod_alignment(&base, &platform).map_or(-1.0, |alignment| alignment.min())
    };
    static EDGE: std::sync::OnceLock<f64> = std::sync::OnceLock::new();
    *EDGE.get_or_init(|| {
        let (mut inside, mut outside) = (0.0, 0.3);
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if alignment(middle) > 0.0 { inside = middle } else { outside = middle }
        }
        inside
    })
}

#[test]
fn whatever_comes_in_the_answer_is_finite_or_an_error() {
    let wanted = std::env::var("RANDOM_CALLS").ok().and_then(|number| number.parse().ok()).unwrap_or(CALLS);
    let mut seen = Seen::default();
    let mut source = Source(Pcg64::seed_from_u64(7));
    while seen.calls < wanted {
        calls(&mut seen, &mut source);
    }
    println!("{} calls: {:?}, saturated {}", seen.calls, seen.kinds, seen.saturated);
    assert_eq!(seen.kinds.len(), KINDS, "kinds of answers seen: {:?}", seen.kinds);
    let least = 1000.min(wanted / 1000);
    for (kind, count) in &seen.kinds {
        assert!(*count >= least, "{kind} only {count} times");
    }
    assert!(seen.saturated >= least);
    let calls: BTreeSet<&str> = seen.by_call.keys().map(|(call, _)| *call).collect();
    for call in calls {
        for kind in kinds(call) {
            assert!(seen.by_call.contains_key(&(call, kind)), "{call}: never {kind}");
        }
    }
}
