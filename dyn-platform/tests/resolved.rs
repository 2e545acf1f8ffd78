//! What valid files become: Table 1, layouts, overrides, defaults, cleaned-up rounding, JSON.

use std::fs;
use std::path::{Path, PathBuf};

use dyn_platform::{LegType, Platform};

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn uhp_2016_text() -> String {
    fs::read_to_string(workspace().join("platforms/uhp_2016.toml")).expect("the default platform")
}

fn resolved(text: &str) -> Platform {
    Platform::from_toml("edited.toml", text).unwrap_or_else(|error| panic!("{error}: {:?}", error.refusals()))
}

/// The default platform with one text replaced by another.
fn uhp_2016_with(good: &str, other: &str) -> Platform {
    let text = uhp_2016_text();
    assert!(text.contains(good), "{good:?} is not in the default platform");
    resolved(&text.replacen(good, other, 1))
}

fn axes(platform: &Platform) -> [[f64; 3]; 6] {
    platform.parameters.leg_vectors("actuator_axis").expect("a parameter of legs uhp")
}

fn platform_files() -> Vec<PathBuf> {
    let mut files = vec![workspace().join("platforms/uhp_2016.toml")];
    for entry in fs::read_dir(workspace().join("tests/platforms")).expect("the test platforms") {
        let path = entry.expect("a folder entry").path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Radius times cosine and sine, typed from GNU bc (20 digits, rounded to 16), not from this crate.
/// Base joints: 0.180 m at -43, 43, 77, 163, 197, 283 degrees; platform joints: 0.120 m at -15, 15, 105, 135, 225, 255.
#[test]
fn leg_coordinates_of_table_1() {
    let base = [
        [0.131_643_666_291_450_7, -0.122_759_704_811_249_7, 0.0],
        [0.131_643_666_291_450_7, 0.122_759_704_811_249_7, 0.0],
        [0.040_491_189_781_895_7, 0.175_386_611_661_342_3, 0.0],
        [-0.172_134_856_073_346_4, 0.052_626_906_850_092_6, 0.0],
        [-0.172_134_856_073_346_4, -0.052_626_906_850_092_6, 0.0],
        [0.040_491_189_781_895_7, -0.175_386_611_661_342_3, 0.0],
    ];
    let platform = [
        [0.115_911_099_154_688_2, -0.031_058_285_412_302_5, 0.0],
        [0.115_911_099_154_688_2, 0.031_058_285_412_302_5, 0.0],
        [-0.031_058_285_412_302_5, 0.115_911_099_154_688_2, 0.0],
        [-0.084_852_813_742_385_7, 0.084_852_813_742_385_7, 0.0],
        [-0.084_852_813_742_385_7, -0.084_852_813_742_385_7, 0.0],
        [-0.031_058_285_412_302_5, -0.115_911_099_154_688_2, 0.0],
    ];
    let uhp = resolved(&uhp_2016_text()).parameters;
    for leg in 0..6 {
        for axis in 0..3 {
            for (point, typed) in [(uhp.base_point, base), (uhp.platform_point, platform)] {
                let difference = (point[leg][axis] - typed[leg][axis]).abs();
                assert!(difference < 1e-16, "leg {}: {:?}", leg + 1, point[leg]);
            }
        }
    }
}

/// The layout closes Table 1: joints 0.09304 m off the axes, actuators 0.19821 m long at home.
#[test]
fn home_of_table_1() {
    let platform = resolved(&uhp_2016_text());
    let (home, uhp) = (platform.home, platform.parameters);
    assert_eq!(home.position, [0.0, 0.0, 0.382]);
    let rod_length = uhp.legs("rod_length").expect("a parameter of legs uhp");
    for (leg, rod_length) in rod_length.into_iter().enumerate() {
        let [x, y, _]: [f64; 3] =
            std::array::from_fn(|axis| uhp.platform_point[leg][axis] - uhp.base_point[leg][axis]);
        let across = x.hypot(y);
        let length = home.position[2] - (rod_length.powi(2) - across.powi(2)).sqrt();
        assert!((across - 0.09304).abs() < 5e-6, "leg {}: {across}", leg + 1);
        assert!((length - 0.19821).abs() < 5e-6, "leg {}: {length}", leg + 1);
    }
}

#[test]
fn other_numbers_of_table_1() {
    let platform = resolved(&uhp_2016_text());
    let expected: [(&str, &[f64]); 14] = [
        ("actuator_axis", &[0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1., 0., 0., 1.]),
        ("rod_length", &[0.206; 6]),
        ("rod_mass", &[1.024; 6]),
        ("rod_com_fraction", &[0.5; 6]),
        ("mover_mass", &[0.611; 6]),
        ("mover_offset", &[0.05; 6]),
        ("rest_length", &[0.198; 6]),
        ("axial_stiffness", &[21_555.9; 6]),
        ("axial_damping", &[0.0; 6]),
        ("payload_mass", &[6.092]),
        ("payload_com", &[0.0, 0.0, 0.031]),
        ("payload_inertia", &[0.025, 0.0, 0.0, 0.0, 0.025, 0.0, 0.0, 0.0, 0.035]),
        ("gravity", &[0.0, 0.0, -9.81]),
        // 1.024 * 0.206^2 / 12
        ("rod_inertia", &[0.003_621_205_333_333_333_3; 6]),
    ];
    for (name, numbers) in expected {
        assert_eq!(platform.parameter(name).as_deref(), Some(numbers), "{name}");
    }
    assert_eq!(platform.parameter("rod_colour"), None);
}

/// Mirror images across the x axis stay exact, so that later stages can share their numbers.
#[test]
fn circular_layouts_are_exactly_symmetric() {
    let uhp = resolved(&uhp_2016_text()).parameters;
    for points in [uhp.base_point, uhp.platform_point] {
        for (one, other) in [(0, 1), (2, 5), (3, 4)] {
            let [x, y, z] = points[one];
            assert_eq!(points[other], [x, -y, z]);
        }
    }
}

#[test]
fn every_platform_file_is_valid_and_named_after_itself() {
    let files = platform_files();
    assert!(files.len() >= 9, "{files:?}");
    for path in files {
        let platform =
            Platform::from_file(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(path.file_stem().and_then(|stem| stem.to_str()), Some(platform.name.as_str()));
    }
}

/// The JSON holds each parameter of the table under its name, in its shape, and nothing else; it reads back the same.
#[test]
fn json_agrees_with_the_table_of_parameters() {
    for path in platform_files() {
        let platform = Platform::from_file(&path).expect("a valid file");
        let text = serde_json::to_string(&platform).expect("plain numbers");
        assert_eq!(serde_json::from_str::<Platform>(&text).expect("its own JSON"), platform);

        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!((&json["version"], &json["leg_type"]), (&1.into(), &platform.leg_type.name().into()));
        let parameters = json["parameters"].as_object().expect("an object");
        assert_eq!(parameters.len(), platform.leg_type.parameters().count());
        for info in platform.leg_type.parameters() {
            let mut numbers = Vec::new();
            flatten(&parameters[info.name], info.shape, &mut numbers);
            assert_eq!(platform.parameter(info.name), Some(numbers), "{}", info.name);
        }
    }
}

fn flatten(value: &serde_json::Value, shape: &[usize], numbers: &mut Vec<f64>) {
    match shape {
        [] => numbers.push(value.as_f64().expect("a number")),
        [length, inner @ ..] => {
            let entries = value.as_array().expect("an array");
            assert_eq!(entries.len(), *length);
            entries.iter().for_each(|entry| flatten(entry, inner, numbers));
        }
    }
}

#[test]
fn json_of_another_version_is_refused() {
    let text = serde_json::to_string(&resolved(&uhp_2016_text())).expect("plain numbers");
    let error =
        serde_json::from_str::<Platform>(&text.replacen("\"version\":1", "\"version\":2", 1)).unwrap_err();
    assert!(error.to_string().contains("version 2"), "{error}");
}

#[test]
fn a_leg_overrides_what_all_legs_share() {
    let leg_3 = "[[leg]]\nnumber = 3\nrod_mass_kg = 2.0\nactuator_axis = [0.0, -0.28, 0.96]\n[payload]";
    let platform = uhp_2016_with("[payload]", leg_3);
    let parameters = &platform.parameters;
    assert_eq!(parameters.legs("rod_mass"), Some([1.024, 1.024, 2.0, 1.024, 1.024, 1.024]));
    let axes = axes(&platform);
    assert_eq!((axes[2], axes[1]), ([0.0, -0.28, 0.96], [0.0, 0.0, 1.0]));
    // The default follows each leg's own mass.
    let inertia = parameters.legs("rod_inertia").expect("a parameter of legs uhp");
    assert_eq!(inertia[2], 2.0 * 0.206_f64.powi(2) / 12.0);
    assert_eq!(inertia[1], 1.024 * 0.206_f64.powi(2) / 12.0);
}

#[test]
fn legs_go_by_their_numbers_not_by_their_order() {
    let path = workspace().join("tests/platforms/everything.toml");
    let platform = Platform::from_file(path).expect("a valid file");
    assert_eq!(platform.parameters.base_point[0], [0.193, -0.156, -0.004]);
    assert_eq!(platform.parameters.legs("rod_length"), Some([0.28, 0.31, 0.26, 0.3, 0.33, 0.29]));
    assert_eq!(platform.home.rotation[0], [0.872, 0.48, 0.096]);
}

#[test]
fn whole_numbers_are_numbers() {
    let parameters = uhp_2016_with("6.092 ", "6 ").parameters;
    assert_eq!(parameters.payload_mass, 6.0);
    assert_eq!(uhp_2016_with("6.092 ", "0x10 ").parameters.payload_mass, 16.0);
}

/// What is right to 1e-9 is taken, and then made right to the last digit.
#[test]
fn rounding_in_the_file_is_removed() {
    // Nothing to remove: the digits stay as they were typed.
    let exact =
        Platform::from_file(workspace().join("tests/platforms/everything.toml")).expect("a valid file");
    assert_eq!(axes(&exact)[5], [0.096, 0.36, 0.928]);
    assert_eq!(exact.home.rotation[2], [-0.2112, 0.192, 0.9584]);

    let norm = |vector: [f64; 3]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();

    let axis = "actuator_axis = [0.1000000000, 0.2000000000, 0.9746794345]";
    let axis = uhp_2016_with("actuator_axis = [0.0, 0.0, 1.0]", axis);
    let axis = axes(&axis)[0];
    assert!((norm(axis) - 1.0).abs() < 3e-16, "{axis:?}");
    assert!((axis[2] - 0.9746794345).abs() < 1e-9);

    let rotation = "0.382]\nrotation = [[0.9950041653, -0.0998334166, 0], [0.0998334166, 0.9950041653, 0], [0, 0, 1]]\n#";
    let rotation = uhp_2016_with("0.382]", rotation).home.rotation;
    for row in rotation {
        assert!((norm(row) - 1.0).abs() < 3e-16, "{rotation:?}");
    }
    assert!((rotation[0][0] - 0.9950041653).abs() < 1e-9);

    let skew = uhp_2016_with("[0.025, 0.0, 0.0]", "[0.025, 1e-13, 0.0]").parameters.payload_inertia;
    assert_eq!((skew[0][1], skew[1][0]), (1e-13, 1e-13));
}

/// A flat plate: the largest moment equals the sum of the others, which a body just may.
#[test]
fn a_flat_body_is_a_body() {
    let parameters = uhp_2016_with("0.035]", "0.05]").parameters;
    assert_eq!(parameters.payload_inertia[2][2], 0.05);
}

#[test]
fn telescopic_legs() {
    let path = workspace().join("tests/platforms/ups_everything.toml");
    let platform = Platform::from_file(path).expect("a valid file");
    assert_eq!(platform.leg_type, LegType::Ups);
    assert_eq!(platform.parameters.base_point[3], [-0.35, 0.33, -0.01]);
    assert_eq!(platform.parameter("lower_mass").map(|masses| masses.len()), Some(6));
    assert_eq!(platform.parameter("rod_length"), None);
    let names: Vec<&str> = platform.parameter_names().collect();
    assert_eq!(names[..3], ["base_point", "platform_point", "lower_mass"]);
}

/// Limits of all legs, overridden by one; a limit that no leg has is absent, a file without limits says nothing of them.
#[test]
fn limits() {
    let common = "[legs]\nminimum_length_m = 0.18\nmaximum_length_m = 0.22\nmaximum_force_n = 150";
    let text = uhp_2016_text().replacen("[legs]", common, 1);
    let leg_2 =
        "[[leg]]\nnumber = 2\nmaximum_length_m = 0.23\nmaximum_hooke_joint_angle_rad = 0.3\n[payload]";
    let platform = resolved(&text.replacen("[payload]", leg_2, 1));
    let json = serde_json::to_value(&platform).expect("plain numbers");
    let expected = serde_json::json!({
        "minimum_length": [0.18, 0.18, 0.18, 0.18, 0.18, 0.18],
        "maximum_length": [0.22, 0.23, 0.22, 0.22, 0.22, 0.22],
        "maximum_force": [150.0, 150.0, 150.0, 150.0, 150.0, 150.0],
        "maximum_hooke_joint_angle": [null, 0.3, null, null, null, null],
    });
    assert_eq!(json["limits"], expected);
    assert_eq!(serde_json::from_value::<Platform>(json).expect("its own JSON"), platform);

    let json = serde_json::to_value(resolved(&uhp_2016_text())).expect("plain numbers");
    assert_eq!(json.get("limits"), None);
}

#[test]
fn json_with_wrong_parameters_is_refused() {
    let json = serde_json::to_value(resolved(&uhp_2016_text())).expect("plain numbers");
    let refused = |change: &dyn Fn(&mut serde_json::Value), words: &str| {
        let mut changed = json.clone();
        change(&mut changed);
        let error = serde_json::from_value::<Platform>(changed).expect_err("wrong parameters").to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&|json| json["parameters"]["rod_mass"] = 1.0.into(), "`rod_mass` is not an array of shape [6]");
    refused(&|json| json["parameters"]["rod_colour"] = 1.0.into(), "unknown parameter `rod_colour`");
    refused(&|json| json["leg_type"] = "ups".into(), "parameter `lower_mass` is missing");
}

/// Two small parts beside a third, which is turned by 90 degrees; calculated by hand.
#[test]
fn parts_of_a_payload_are_summed() {
    let text = uhp_2016_text();
    let start = text.find("[payload]").expect("a payload");
    let parts = "
        [[payload.part]]
        name = \"middle\"
        mass_kg = 2.0
        com_m = [0.0, 0.0, 0.1]
        inertia_kg_m2 = [[0.01, 0.0, 0.003], [0.0, 0.02, 0.0], [0.003, 0.0, 0.025]]
        rotation = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
        [[payload.part]]
        mass_kg = 1.0
        com_m = [0.0, 0.3, 0.1]
        inertia_kg_m2 = [[1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1e-3]]
        [[payload.part]]
        mass_kg = 1.0
        com_m = [0.2, -0.3, 0.1]
        inertia_kg_m2 = [[1e-3, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 1e-3]]
    ";
    let parameters = resolved(&(text[..start].to_owned() + parts)).parameters;
    assert_eq!(parameters.payload_mass, 4.0);
    let near = |found: &[f64], typed: &[f64]| {
        assert!(
            found.iter().zip(typed).all(|(a, b)| (a - b).abs() < 1e-15),
            "{found:?} instead of {typed:?}"
        );
    };
    near(&parameters.payload_com, &[0.05, 0.0, 0.1]);
    // The turn takes x to y, hence yz: 0.003. From the common centre of mass the middle is at (-0.05, 0), the second part at
    // (-0.05, 0.3) and the third at (0.15, -0.3), all in the plane z = 0.1, hence
    // xx: 0.02 + 2e-3 + 2 * 0.09, yy: 0.01 + 2e-3 + 2 * 0.0025 + 0.0025 + 0.0225, xy: -(-0.015 - 0.045).
    near(
        parameters.payload_inertia.as_flattened(),
        &[0.202, 0.06, 0.0, 0.06, 0.042, 0.003, 0.0, 0.003, 0.237],
    );
}

#[test]
fn committed_files_give_no_warning() {
    for path in platform_files() {
        assert_eq!(Platform::from_file(&path).expect("a valid file").warnings, [], "{}", path.display());
    }
}
