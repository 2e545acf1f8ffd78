//! Inputs and outputs by name.

#[macro_use]
mod common;

use common::{random_states, table_1, uhp_cases};
use dyn_reference::inputs::{InputError, PARAMETERS, STATE};
use dyn_reference::outputs::{Output, output, outputs};
use dyn_reference::{LegType, Mechanism, Parameters, State, leg_kinematics, partial_velocities, uhp, ups};

fn outputs_of<L: LegType>(_: &Parameters<L>) -> impl Iterator<Item = &'static Output<L>> {
    outputs::<L>()
}

#[test]
fn outputs_have_unique_names_and_the_shapes_they_announce() {
    for_random_states!(30, 1, |case, state| {
        let rows: Vec<_> = outputs_of(&case.parameters).collect();
        for (i, row) in rows.iter().enumerate() {
            assert!(rows[..i].iter().all(|earlier| earlier.name != row.name), "{} twice", row.name);
            let mut values = Vec::new();
            assert!(output(&case.parameters, state, row.name, &mut values));
            assert_eq!(values.len(), row.entries(), "{}", row.name);
            assert!(values.iter().all(|value| value.is_finite()), "{}", row.name);
        }
        let mut values = Vec::new();
        assert!(!output(&case.parameters, state, "no_such_output", &mut values));
        assert!(values.is_empty());
    });
}

#[test]
fn arrays_are_row_major_and_appended() {
    random_states(31, 1, uhp_cases(), |case, state| {
        let mut values = vec![1.0];
        output(&case.parameters, state, "rod_partial_velocity", &mut values);
        let expected = partial_velocities(&case.parameters, state).com_partial_velocity;
        assert_eq!(values[1 + 2 * 18 + 6 + 4], expected[2][0][(1, 4)]);
        values.clear();
        output(&case.parameters, state, "hooke_joint_position", &mut values);
        assert_eq!(values[3 * 5 + 2], leg_kinematics(&case.parameters, state).hooke_joint_position[5].z);
    });
}

#[test]
fn results_without_a_solution_are_nan() {
    let case = table_1();
    let mut state = common::random_state(&case, &mut common::random(32));
    state.platform.position_m.x += 1.0;
    for name in ["inverse_dynamics", "forward_dynamics"] {
        let mut values = Vec::new();
        output(&case.parameters, &state, name, &mut values);
        assert!(values.len() == 6 && values.iter().all(|value| value.is_nan()), "{name}");
    }
}

type Shape = (&'static str, &'static [usize]);

/// The table of a leg type's parameters.
fn parameters_of<L: LegType>() -> Vec<Shape> {
    [L::PARAMETERS, PARAMETERS].concat()
}

/// Consecutive integers, so that every entry is known.
fn counted(table: &[Shape], name: &str) -> Option<Vec<f64>> {
    let before: usize =
        table.iter().take_while(|row| row.0 != name).map(|row| row.1.iter().product::<usize>()).sum();
    let count: usize = table.iter().find(|row| row.0 == name)?.1.iter().product();
    Some((before..before + count).map(|value| value as f64).collect())
}

#[test]
fn parameters_are_read_by_name() {
    let parameters =
        Parameters::<uhp::Leg>::from_arrays(|name| counted(&parameters_of::<uhp::Leg>(), name)).unwrap();
    let leg = &parameters.legs[4];
    assert_eq!(leg.base_point_m.as_slice(), [12.0, 13.0, 14.0]);
    assert_eq!(leg.actuator_axis.as_slice(), [30.0, 31.0, 32.0]);
    assert_eq!(leg.platform_point_m.as_slice(), [48.0, 49.0, 50.0]);
    let scalars = [
        leg.rod_length_m,
        leg.rod_mass_kg,
        leg.rod_inertia_kg_m2,
        leg.rod_com_fraction,
        leg.mover_mass_kg,
        leg.mover_offset_m,
        leg.rest_length_m,
        leg.axial_stiffness_n_m,
        leg.axial_damping_n_s_m,
    ];
    assert_eq!(scalars, std::array::from_fn(|i| 54.0 + 6.0 * i as f64 + 4.0));
    assert_eq!(parameters.payload.mass_kg, 108.0);
    assert_eq!(parameters.payload.com_m.as_slice(), [109.0, 110.0, 111.0]);
    // The upper triangle of [112 113 114; 115 116 117; 118 119 120], mirrored.
    let inertia = [112.0, 113.0, 114.0, 113.0, 116.0, 117.0, 114.0, 117.0, 120.0];
    assert_eq!(parameters.payload.inertia_kg_m2.as_slice(), inertia);
    assert_eq!(parameters.gravity_m_s2.as_slice(), [121.0, 122.0, 123.0]);
}

#[test]
fn parameters_of_telescopic_legs_are_read_by_name() {
    let read = |name: &str| counted(&parameters_of::<ups::Leg>(), name);
    let parameters = Parameters::<ups::Leg>::from_arrays(read).unwrap();
    let leg = &parameters.legs[4];
    assert_eq!(leg.base_point_m.as_slice(), [12.0, 13.0, 14.0]);
    assert_eq!(leg.platform_point_m.as_slice(), [30.0, 31.0, 32.0]);
    let scalars = [
        leg.lower_mass_kg,
        leg.lower_com_distance_m,
        leg.lower_inertia_kg_m2,
        leg.upper_mass_kg,
        leg.upper_com_distance_m,
        leg.upper_inertia_kg_m2,
        leg.rest_length_m,
        leg.axial_stiffness_n_m,
        leg.axial_damping_n_s_m,
    ];
    assert_eq!(scalars, std::array::from_fn(|i| 36.0 + 6.0 * i as f64 + 4.0));
    assert_eq!(Mechanism::from_arrays("ups", read), Some(Ok(Mechanism::Ups(parameters))));
    assert_eq!(Mechanism::from_arrays("rpr", read), None);
}

#[test]
fn states_are_read_by_name() {
    let state = State::from_arrays(|name| counted(STATE, name)).unwrap();
    assert_eq!(state.base.position_m.z, 2.0);
    assert_eq!(state.base.rotation[(1, 2)], 8.0);
    assert_eq!(state.base.velocity[3], 15.0);
    assert_eq!(state.base.acceleration[0], 18.0);
    assert_eq!(state.platform.position_m.x, 24.0);
    assert_eq!(state.platform.rotation[(2, 0)], 33.0);
    assert_eq!(state.platform.velocity[5], 41.0);
    assert_eq!(state.platform.acceleration[1], 43.0);
    assert_eq!(state.actuator_force_n[5], 53.0);
    assert_eq!(state.external_wrench[0], 54.0);
    assert_eq!(state.reference_velocity[0], 60.0);
}

#[test]
fn missing_and_misshapen_inputs_are_refused() {
    let table = parameters_of::<uhp::Leg>();
    let missing =
        Parameters::<uhp::Leg>::from_arrays(|name| counted(&table, name).filter(|_| name != "rod_mass"));
    assert_eq!(missing, Err(InputError { name: "rod_mass", expected: 6, found: None }));
    let short = State::from_arrays(|name| match name {
        "base_rotation" => Some(vec![0.0; 8]),
        _ => counted(STATE, name),
    });
    let error = short.unwrap_err();
    assert_eq!(error, InputError { name: "base_rotation", expected: 9, found: Some(8) });
    assert_eq!(error.to_string(), "`base_rotation` has 8 numbers; give 9");
}
