//! Every call of the runtime crate, as a program for a machine without operating system would make it. The object that comes out must not
//! contain a way to panic.
#![no_std]

use core::panic::PanicInfo;

use dyn_runtime::current::VoiceCoils;
use dyn_runtime::models::{PreparedUhp, PreparedUps, Uhp, Uhp2016, Ups};
use dyn_runtime::nalgebra::Vector6;
use dyn_runtime::{
    Acceleration, BaseMotion, Hexapod, Limits, PlatformState, Pose, Real, Twist, Wrench, angles, kernels,
    rotation_vector,
};

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    loop {}
}

/// Everything that goes into calls.
pub struct Arguments<T: Real> {
    base: BaseMotion<T>,
    platform: PlatformState<T>,
    acceleration: Acceleration<T>,
    reference: Twist<T>,
    wrench: Wrench<T>,
    forces: Vector6<T>,
    limits: Limits<T>,
    coils: VoiceCoils<T>,
    start: Pose<T>,
}

/// `baked run_time single: |hexapod, arguments| call`, of the baked model, the one with parameters at run time, and the baked one in
/// single precision; true where there is a result.
macro_rules! checked {
    ($($baked:ident $run_time:ident $single:ident: |$h:ident, $a:ident| $call:expr;)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $baked($a: &Arguments<f64>) -> bool {
            let $h = Hexapod::new(Uhp2016);
            core::hint::black_box($call).is_ok()
        }

        of_run_time!($run_time: Uhp, |$h, $a| $call);

        #[unsafe(no_mangle)]
        pub extern "C" fn $single($a: &Arguments<f32>) -> bool {
            let $h = Hexapod::single_precision(Uhp2016);
            core::hint::black_box($call).is_ok()
        }
    )*};
}

/// A call of a model with parameters at run time.
macro_rules! of_run_time {
    ($name:ident: $model:ty, |$h:ident, $a:ident| $call:expr) => {
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($h: &Hexapod<$model>, $a: &Arguments<f64>) -> bool {
            core::hint::black_box($call).is_ok()
        }
    };
}

/// The same for calls that every leg type has: legs of the type UPS besides.
macro_rules! checked_for_all_legs {
    ($($baked:ident $run_time:ident $ups:ident $single:ident: |$h:ident, $a:ident| $call:expr;)*) => {$(
        checked! { $baked $run_time $single: |$h, $a| $call; }
        of_run_time!($ups: Ups, |$h, $a| $call);
    )*};
}

checked_for_all_legs! {
    rod_alignment rod_alignment_uhp rod_alignment_ups rod_alignment_f32: |h, a| h.rod_alignment(&a.base, &a.platform);
    leg_kinematics leg_kinematics_uhp leg_kinematics_ups leg_kinematics_f32: |h, a| h.leg_kinematics(&a.base, &a.platform, &a.acceleration);
    jacobian_dp jacobian_dp_uhp jacobian_dp_ups jacobian_dp_f32: |h, a| h.jacobian_dp(&a.base, &a.platform);
    jacobian_db jacobian_db_uhp jacobian_db_ups jacobian_db_f32: |h, a| h.jacobian_db(&a.base, &a.platform);
    mass_matrix_p mass_matrix_p_uhp mass_matrix_p_ups mass_matrix_p_f32: |h, a| h.mass_matrix_p(&a.base, &a.platform);
    mass_matrix_b mass_matrix_b_uhp mass_matrix_b_ups mass_matrix_b_f32: |h, a| h.mass_matrix_b(&a.base, &a.platform);
    coriolis_matrices coriolis_matrices_uhp coriolis_matrices_ups coriolis_matrices_f32: |h, a| h.coriolis_matrices(&a.base, &a.platform);
    stiffness_matrices stiffness_matrices_uhp stiffness_matrices_ups stiffness_matrices_f32: |h, a| h.stiffness_matrices(&a.base, &a.platform);
    matrices matrices_uhp matrices_ups matrices_f32: |h, a| h.matrices(&a.base, &a.platform);
    passive_forces passive_forces_uhp passive_forces_ups passive_forces_f32: |h, a| h.passive_forces(&a.base, &a.platform);
    bias bias_uhp bias_ups bias_f32: |h, a| h.bias(&a.base, &a.platform);
    equation_of_motion equation_of_motion_uhp equation_of_motion_ups equation_of_motion_f32: |h, a| h.equation_of_motion(&a.base, &a.platform);
    inverse_dynamics inverse_dynamics_uhp inverse_dynamics_ups inverse_dynamics_f32:
        |h, a| h.inverse_dynamics(&a.base, &a.platform, &a.acceleration, &a.wrench);
    forward_dynamics forward_dynamics_uhp forward_dynamics_ups forward_dynamics_f32:
        |h, a| h.forward_dynamics(&a.base, &a.platform, &a.forces, &a.wrench);
    energy energy_uhp energy_ups energy_f32: |h, a| h.energy(&a.base, &a.platform);
    control control_uhp control_ups control_f32: |h, a| h.control(&a.base, &a.platform, &a.acceleration, &a.wrench);
    passive_inverse_dynamics passive_inverse_dynamics_uhp passive_inverse_dynamics_ups passive_inverse_dynamics_f32:
        |h, a| h.passive_inverse_dynamics(&a.base, &a.platform, &a.reference, &a.acceleration, &a.wrench);
    base_reaction base_reaction_uhp base_reaction_ups base_reaction_f32:
        |h, a| h.base_reaction(&a.base, &a.platform, &a.acceleration, &a.wrench);
    forward_kinematics forward_kinematics_uhp forward_kinematics_ups forward_kinematics_f32:
        |h, a| h.forward_kinematics(&a.base.pose, &a.forces, &a.start);
    platform_velocity platform_velocity_uhp platform_velocity_ups platform_velocity_f32:
        |h, a| h.platform_velocity(&a.base, &a.start, &a.forces);
    monitor monitor_uhp monitor_ups monitor_f32:
        |h, a| h.monitor(&a.base, &a.platform, &a.forces, &a.limits).and_then(|monitor| monitor.check());
}

checked! {
    body_kinematics body_kinematics_uhp body_kinematics_f32: |h, a| h.body_kinematics(&a.base, &a.platform, &a.acceleration);
    partial_velocities partial_velocities_uhp partial_velocities_f32: |h, a| h.partial_velocities(&a.base, &a.platform);
    generalised_forces generalised_forces_uhp generalised_forces_f32:
        |h, a| h.generalised_forces(&a.base, &a.platform, &a.acceleration, &a.forces, &a.wrench);
    currents currents_uhp currents_f32: |_h, a| a.coils.currents(&a.forces);
}

of_run_time!(body_kinematics_ups: Ups, |h, a| h.ups_body_kinematics(&a.base, &a.platform, &a.acceleration));
of_run_time!(partial_velocities_ups: Ups, |h, a| h.ups_partial_velocities(&a.base, &a.platform));
of_run_time!(generalised_forces_ups: Ups, |h, a| h.ups_generalised_forces(&a.base, &a.platform, &a.acceleration, &a.forces, &a.wrench));

/// Calls of models whose parameters are prepared.
macro_rules! checked_when_prepared {
    ($($uhp:ident $ups:ident: |$h:ident, $a:ident| $call:expr;)*) => {$(
        of_run_time!($uhp: PreparedUhp, |$h, $a| $call);
        of_run_time!($ups: PreparedUps, |$h, $a| $call);
    )*};
}

checked_when_prepared! {
    inverse_dynamics_prepared_uhp inverse_dynamics_prepared_ups:
        |h, a| h.inverse_dynamics(&a.base, &a.platform, &a.acceleration, &a.wrench);
    forward_dynamics_prepared_uhp forward_dynamics_prepared_ups:
        |h, a| h.forward_dynamics(&a.base, &a.platform, &a.forces, &a.wrench);
    control_prepared_uhp control_prepared_ups: |h, a| h.control(&a.base, &a.platform, &a.acceleration, &a.wrench);
    forward_kinematics_prepared_uhp forward_kinematics_prepared_ups:
        |h, a| h.forward_kinematics(&a.base.pose, &a.forces, &a.start);
}

/// What prepares them.
#[unsafe(no_mangle)]
pub extern "C" fn prepared_uhp(model: &Uhp, prepared: &mut PreparedUhp) {
    *prepared = model.clone().prepared();
}

/// The same for legs of the type UPS.
#[unsafe(no_mangle)]
pub extern "C" fn prepared_ups(model: &Ups, prepared: &mut PreparedUps) {
    *prepared = model.clone().prepared();
}

/// `double single: |arguments| call` without a model.
macro_rules! conversions {
    ($($double:ident $single:ident: |$a:ident| $call:expr;)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $double($a: &Arguments<f64>) {
            core::hint::black_box($call);
        }

        #[unsafe(no_mangle)]
        pub extern "C" fn $single($a: &Arguments<f32>) {
            core::hint::black_box($call);
        }
    )*};
}

conversions! {
    pose_from_angles pose_from_angles_f32: |a| Pose::from_paper_angles(a.wrench.force_n, a.wrench.moment_n_m.into());
    pose_from_matrix pose_from_matrix_f32: |a| Pose::from_rotation_matrix(a.wrench.force_n, a.start.rotation.matrix()).is_ok();
    pose_from_quaternion pose_from_quaternion_f32: |a| {
        Pose::from_quaternion(a.wrench.force_n, [a.forces[0], a.forces[1], a.forces[2], a.forces[3]]).is_ok()
    };
    angles_of_rotation angles_of_rotation_f32: |a| angles::from_rotation(&a.start.rotation);
    angle_rates angle_rates_f32: |a| angles::angle_rates(a.wrench.force_n.into(), a.wrench.moment_n_m).is_ok();
    angular_velocity angular_velocity_f32:
        |a| angles::angular_velocity(a.wrench.force_n.into(), a.wrench.moment_n_m.into());
    angular_acceleration angular_acceleration_f32: |a| angles::angular_acceleration(
        a.wrench.force_n.into(),
        a.wrench.moment_n_m.into(),
        a.start.position_m.into(),
    );
    rotation_vector rotation_vector_f32: |a| rotation_vector::rotation(&a.wrench.force_n);
    rotation_vector_motion rotation_vector_motion_f32:
        |a| rotation_vector::angular_motion(&a.wrench.force_n, &a.wrench.moment_n_m, &a.start.position_m);
    rotation_vector_rate rotation_vector_rate_f32:
        |a| rotation_vector::rate_within_step(&a.wrench.force_n, &a.wrench.moment_n_m);
    orthonormalised orthonormalised_f32: |a| rotation_vector::orthonormalised(&a.start.rotation);
}

/// An unchecked call.
#[unsafe(no_mangle)]
pub extern "C" fn unchecked(poses: &[[f64; 3]; 2], rotations: &[[[f64; 3]; 3]; 2], rod_alignment: &mut [f64; 6]) {
    let ([base, platform], [from_base, from_platform]) = (poses, rotations);
    kernels::RodAlignment::rod_alignment(&Uhp2016, base, from_base, platform, from_platform, rod_alignment);
}

/// What the search must find: a panic.
#[unsafe(no_mangle)]
pub extern "C" fn can_panic(numbers: &[f64; 6], index: usize) -> f64 {
    numbers[index]
}

/// What the search must find: a loop that ends when the numbers say so.
#[unsafe(no_mangle)]
pub extern "C" fn can_run_on(number: f64, factor: f64) -> f64 {
    let mut number = number;
    while number > 1.0 {
        number *= factor;
    }
    number
}

/// What the search must find: a call of whatever comes.
#[unsafe(no_mangle)]
pub extern "C" fn can_lead_anywhere(call: extern "C" fn(f64) -> f64, number: f64) -> f64 {
    call(number) + 1.0
}
