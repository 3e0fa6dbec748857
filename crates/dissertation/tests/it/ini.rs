//! Ini files: round trip, ranges, and errors with their line.

use teeter_dissertation::jenga3d::{
    Constant, Constants, Disabling, Jenga3D, Method, Order, Range, SpringSet, TABLE, Value,
};
use teeter_scene::named;

#[test]
fn an_ini_file_round_trips() {
    let constants = Constants {
        stiffness: 12_345.678,
        static_friction: Some(0.45),
        method: Method::Rk4,
        disabling: Disabling::Rigid,
        order: Order::TopDown,
        springs: SpringSet::Faces,
        disable_threshold: 1.0 / 3.0e6,
        friction_enabled: false,
        ..Constants::default()
    };
    assert_eq!(Constants::from_ini(&constants.to_ini()), Ok(constants));
    assert_eq!(Constants::from_ini(&Constants::default().to_ini()), Ok(Constants::default()));
    assert_eq!(Constants::from_ini(""), Ok(Constants::default()));
    let some =
        Constants::from_ini("; softer\n[Springs]\n stiffness = 5e3 # N/m\n\n[Integration]\niterations_per_frame=7\n")
            .unwrap();
    assert_eq!((some.stiffness, some.iterations_per_frame), (5e3, 7));
    // As an editor of 2003 saves it.
    let dos = Constants::from_ini("\u{feff}[Springs]\r\nstiffness = 5e3\r\n").unwrap();
    assert_eq!(dos.stiffness, 5e3);
}

/// The file that is written explains each constant: meaning, range with unit, default, reason.
#[test]
fn a_written_file_explains_every_constant() {
    let text = Constants::default().to_ini();
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    for constant in TABLE {
        let line = format!("{} = {}", constant.name, constant.default());
        assert!(text.lines().any(|l| l == line), "{line}");
        let flat = text.replace("\n;   ", " ");
        for part in [constant.meaning, &constant.expected(), constant.unit, constant.reason] {
            assert!(flat.contains(part), "{}: {part}", constant.name);
        }
        assert!(!constant.meaning.is_empty() && !constant.reason.is_empty(), "{}", constant.name);
    }
}

/// Every field of the constants is in the table: each entry changes a value that no other changes.
#[test]
fn the_table_has_every_constant_once() {
    for constant in TABLE {
        let default = constant.default();
        let other = match (constant.range, default) {
            (Range::Number { min, .. } | Range::NumberOrNone { min, .. }, Value::Number(x)) => {
                if x == min {
                    "0.5".to_owned()
                } else {
                    Value::Number(min).to_string()
                }
            }
            (Range::NumberOrNone { max, .. }, _) => max.to_string(),
            (Range::Whole { max, .. }, _) => max.to_string(),
            (_, Value::Switch(on)) => (!on).to_string(),
            (Range::Choice { names, .. }, _) => {
                names.iter().find(|n| Value::Choice(n) != default).expect("another").to_string()
            }
            other => panic!("{other:?}"),
        };
        let mut changed = Constants::default();
        changed.set(constant.name, &other).unwrap();
        assert_ne!(changed, Constants::default(), "{}", constant.name);
        let same = TABLE.iter().filter(|c| c.value(&changed) == c.default()).count();
        assert_eq!(same, TABLE.len() - 1, "{}", constant.name);
    }
    // Debug prints one line a field.
    let fields = format!("{:#?}", Constants::default()).lines().filter(|line| line.starts_with("    ")).count();
    assert_eq!(fields, TABLE.len());
}

/// Older names, and those of switches, are read.
#[test]
fn other_names_are_read() {
    for (name, text, expected) in [
        ("method", "multi", "multistep"),
        ("disabling", "rigid", "rigid-motion"),
        ("culling", "on", "planes"),
        ("culling", "off", "none"),
        ("listed_boxes", "on", "true"),
        ("friction_enabled", "no", "false"),
    ] {
        let mut constants = Constants::default();
        constants.set(name, text).unwrap();
        assert_eq!(constants.value(name).unwrap().to_string(), expected);
    }
}

#[test]
fn errors_name_their_line() {
    for (text, expected) in [
        (
            "[Spring]",
            "line 1: there is no section [Spring], expected Simulation, Integration, Springs, Contact, Friction, \
             Disabling or Hand",
        ),
        ("[Springs]\nfriction = 1", "line 2: there is no `friction` in section [Springs]: it is in [Friction]"),
        ("[Springs]\ntension = 1", "line 2: there is no `tension` in section [Springs]"),
        ("stiffness = 1", "line 1: there is no `stiffness` before the first section: it is in [Springs]"),
        ("[Springs]\n\nstiffness = much", "line 3: `stiffness` is `much`, expected a number from 1 to 1e9 N/m"),
        ("[Springs]\nstiffness =", "line 2: `stiffness` is ``, expected a number from 1 to 1e9 N/m"),
        ("[Springs]\nstiffness", "line 2: `stiffness`, expected `name = value` or `[Section]`"),
        (
            "[Springs]\nstiffness = 1e4\nstiffness = 2e4",
            "line 3: `stiffness` is set again, expected once: line 2 sets it",
        ),
        ("[Integration]\nmethod = verlet", "line 2: `method` is `verlet`, expected euler, multistep, midpoint or rk4"),
        ("[Contact]\nlisted_boxes = maybe", "line 2: `listed_boxes` is `maybe`, expected true or false"),
    ] {
        assert_eq!(Constants::from_ini(text).unwrap_err().to_string(), expected);
    }
}

/// Values out of a range, among them the neighbours of each end, are refused by field, value and
/// range.
#[test]
fn values_out_of_range_are_refused() {
    for constant in TABLE {
        let mut odd = vec![String::new(), "none of it".to_owned(), "1 2".to_owned()];
        match constant.range {
            Range::Number { min, max } | Range::NumberOrNone { min, max } => {
                odd.extend(["NaN", "inf", "-inf", "1e400", "-1"].map(str::to_owned));
                odd.extend([(min - 1e-9 * max).to_string(), (max * (1.0 + 1e-9)).to_string()]);
            }
            Range::Whole { min, max } => {
                odd.extend(["-1", "1.5", "4294967295", "4294967296", "NaN"].map(str::to_owned));
                odd.push((max + 1).to_string());
                odd.extend(min.checked_sub(1).map(|n| n.to_string()));
            }
            Range::Switch => odd.push("2".to_owned()),
            Range::Choice { .. } => odd.extend(["None", "0"].map(str::to_owned)),
        }
        for text in odd {
            let file = format!("[{}]\n{} = {text}", constant.section, constant.name);
            let error = Constants::from_ini(&file).expect_err(&file).to_string();
            let shown = if text.parse::<f64>().is_ok() { text } else { format!("`{text}`") };
            assert_eq!(error, format!("line 2: `{}` is {shown}, expected {}", constant.name, constant.expected()));
        }
    }
    assert_eq!(Constants::from_ini("[Friction]\nstatic_friction = none").unwrap().static_friction, None);
}

/// Constants that code sets are checked as those of a file.
#[test]
fn constants_in_code_are_checked_too() {
    let block = named("block").unwrap();
    let default = Constants::default;
    for (name, constants) in [
        ("static_friction", Constants { static_friction: Some(-1.0), ..default() }),
        ("drag", Constants { drag: f64::NAN, ..default() }),
        ("mid_loop_count", Constants { mid_loop_count: u32::MAX, ..default() }),
        ("max_sweeps", Constants { max_sweeps: 0, ..default() }),
        ("stiffness", Constants { stiffness: 1e6, ..default() }),
        ("damping", Constants { damping: 100.0, ..default() }),
        ("mid_loop_count", Constants { mid_loop_count: 16, ..default() }),
        ("mid_loop_count", Constants { frame_rate: 1.0, ..default() }),
        (
            "hand_rate",
            Constants {
                hand_rate: 1000.0,
                frame_rate: 10.0,
                mid_loop_count: 90,
                iterations_per_frame: 20,
                ..default()
            },
        ),
        ("rest_distance", Constants { disabling: Disabling::Rigid, rest_time: 0.01, rest_distance: 1e-3, ..default() }),
    ] {
        let error = Jenga3D::new(&block, constants.clone()).expect_err(name).to_string();
        let value = constants.value(name).expect("the table has it");
        assert!(error.starts_with(&format!("`{name}` is {value}, expected ")), "{error}");
        let mut simulator = Jenga3D::new(&block, default()).unwrap();
        assert_eq!(simulator.set_constants(constants).expect_err(name).to_string(), error);
        assert_eq!(simulator.constants, default());
    }
}

/// The data of the table, as a page receives it.
#[test]
fn the_table_is_data() {
    let stiffness = serde_json::to_value(Constant::find("stiffness").unwrap()).unwrap();
    assert_eq!(stiffness["range"], serde_json::json!({"kind": "number", "min": 1.0, "max": 1e9}));
    assert_eq!((&stiffness["unit"], &stiffness["default"]), (&"N/m".into(), &1e4.into()));
    let order = serde_json::to_value(Constant::find("order").unwrap()).unwrap();
    assert_eq!(order["range"]["names"], serde_json::json!(["naive", "bottom-up", "top-down"]));
    assert_eq!(order["default"], "naive");
}
