//! Checks of parameters, each refusal with its text.

use dyn_runtime::parameter::{Domain, check};

fn refusal(domain: Domain, values: &[f64]) -> String {
    check("x", domain, values).unwrap_err().to_string()
}

#[test]
fn what_is_refused_and_what_is_said() {
    let cases: [(Domain, &[f64], &str); 8] = [
        (Domain::Any, &[1.0, f64::NAN], "element 1 is NaN or infinite"),
        (Domain::Positive, &[1.0, 0.0], "element 1 must be positive, but is 0"),
        (Domain::NotNegative, &[-2.5], "element 0 must not be negative, but is -2.5"),
        (Domain::Fraction, &[0.5, 1.5], "element 1 must lie between 0 and 1, but is 1.5"),
        (
            Domain::UnitVectors,
            &[0.0, 0.0, 1.0, 0.0, 2.0, 0.0],
            "elements 3 to 5 must be a unit vector, but its length is 2; divide it by that",
        ),
        (
            Domain::Inertia,
            &[1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            "the inertia tensor is not symmetric",
        ),
        (
            Domain::Inertia,
            &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.5],
            "no body has this inertia tensor: a principal moment is not positive or exceeds the sum of the others",
        ),
        (
            Domain::Inertia,
            &[1.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            "no body has this inertia tensor: a principal moment is not positive or exceeds the sum of the others",
        ),
    ];
    for (domain, values, text) in cases {
        assert_eq!(refusal(domain, values), format!("parameter `x` keeps its value: {text}"));
    }
    assert!(check("x", Domain::Positive, &[f32::INFINITY]).is_err());
}

#[test]
fn what_bodies_have_is_accepted() {
    // A flat disc, a rod of no thickness but for its axis, a body turned by 45 degrees about z.
    let bodies: [[f64; 9]; 3] = [
        [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0],
        [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1e-3],
        [1.5, 0.5, 0.0, 0.5, 1.5, 0.0, 0.0, 0.0, 2.5],
    ];
    for body in bodies {
        assert_eq!(check("x", Domain::Inertia, &body), Ok(()));
        assert_eq!(check("x", Domain::Inertia, &body.map(|x| x as f32)), Ok(()));
    }
    let third = 1.0 / 3.0_f64.sqrt();
    assert_eq!(check("x", Domain::UnitVectors, &[third; 3]), Ok(()));
    assert_eq!(check("x", Domain::UnitVectors, &[third as f32; 3]), Ok(()));
    assert_eq!(check("x", Domain::NotNegative, &[0.0]), Ok(()));
    assert_eq!(check("x", Domain::Fraction, &[0.0, 1.0]), Ok(()));
}
