//! Mistakes that serde finds: no TOML, unknown and missing keys, wrong types.

use dyn_platform::{Refusal, first_line, nearest};

/// Keys with an example of each: remedies are made from it.
const EXAMPLES: &[(&str, &str)] = &[
    ("version", "version = 1"),
    ("name", r#"name = "my_experiment""#),
    ("platform", r#"platform = "../platforms/uhp_2016.toml""#),
    ("gravity", "gravity = true"),
    ("duration_s", "duration_s = 1.0"),
    ("step_s", "step_s = 1e-4"),
    ("integrator", r#"integrator = "lie_rk4""#),
    ("prototype", "prototype = false"),
    ("frequency_hz", "frequency_hz = 40.0"),
    ("linear_m_per_s2", "linear_m_per_s2 = [0.004, 0.0, 0.0]"),
    ("linear_m", "linear_m = [0.01, 0.0, 0.0]"),
    ("linear_phase_rad", "linear_phase_rad = [0.0, 1.57, 0.0]"),
    ("angular_rad_per_s2", "angular_rad_per_s2 = [0.02, 0.0, 0.0]"),
    ("rotation_rad", "rotation_rad = [0.1, 0.0, 0.0]"),
    ("angular_phase_rad", "angular_phase_rad = [0.0, 1.57, 0.0]"),
    ("actuator_length_m", "actuator_length_m = [0.15, 0.25]"),
    ("frequencies_hz", "frequencies_hz = [40.0, 100.0]"),
    ("relative_to", r#"relative_to = "base""#),
    ("window", r#"window = "hann""#),
    ("csv", r#"csv = "measured.csv""#),
];

const DESCRIBED: &str = "scenarios/README.md lists every key";

/// What serde's error becomes.
pub(crate) fn refusal(error: &toml::de::Error, text: &str) -> Refusal {
    let at = error.span().unwrap_or_else(|| first_line(text));
    let message = error.message();
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if text.trim().is_empty() {
        let help = format!("start from a copy of scenarios/published.toml; {DESCRIBED}");
        return Refusal::new(at, "no key in this file", "the scenario file is empty", help);
    }
    match quoted.as_slice() {
        [key, known @ ..] if message.starts_with("unknown field") => {
            let help = match nearest(key, known.iter().copied()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("keys known here: {}", known.join(", ")),
            };
            Refusal::new(at, "unknown key", format!("unknown key `{key}`"), help)
        }
        [value, known @ ..] if message.starts_with("unknown variant") => {
            let help = match nearest(value, known.iter().copied()) {
                Some(meant) => format!("did you mean {meant:?}?"),
                None => format!("known here: {}", known.join(", ")),
            };
            Refusal::new(at, "unknown", format!("{value:?} is unknown here"), help)
        }
        [key] if message.starts_with("missing field") => {
            // A missing key has no place of its own: serde gives the table's, or the whole file's.
            let at = at.start..at.start + first_line(&text[at.start..]).end;
            Refusal::new(at, format!("no `{key}` here"), format!("`{key}` is missing"), remedy(key))
        }
        _ if message.starts_with("invalid") => {
            let key = key_before(text, at.start);
            Refusal::new(at, "not so", format!("`{key}`: {message}"), remedy(key))
        }
        _ => Refusal::new(
            at,
            "here",
            format!("this is not TOML: {message}"),
            "mend the syntax; https://toml.io describes it",
        ),
    }
}

fn remedy(key: &str) -> String {
    match EXAMPLES.iter().find(|(name, _)| *name == key) {
        Some((_, example)) => format!("for example `{example}`; {DESCRIBED}"),
        None => DESCRIBED.to_owned(),
    }
}

/// The key whose value stands at `place`.
fn key_before(text: &str, place: usize) -> &str {
    let before = &text[..place];
    let Some(equals) = before.rfind('=') else { return "the file" };
    let line = before[..equals].rfind('\n').map_or(0, |end| end + 1);
    before[line..equals].trim()
}
