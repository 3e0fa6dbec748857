//! Ini files: round trip, and errors with their line.

use teeter_dissertation::jenga3d::{Constants, Disabling, Jenga3D, Method};
use teeter_scene::named;

#[test]
fn an_ini_file_round_trips() {
    let constants = Constants {
        stiffness: 12_345.678,
        static_friction: Some(0.45),
        method: Method::Rk4,
        disabling: Disabling::Rigid,
        ..Constants::default()
    };
    assert_eq!(Constants::from_ini(&constants.to_ini()), Ok(constants));
    assert_eq!(Constants::from_ini(""), Ok(Constants::default()));
    let some =
        Constants::from_ini("; softer\n[Springs]\n stiffness = 5e3 # N/m\n\n[Integration]\niterations_per_frame=7\n")
            .unwrap();
    assert_eq!((some.stiffness, some.iterations_per_frame), (5e3, 7));
}

#[test]
fn errors_name_their_line() {
    for (text, expected) in [
        ("[Spring]", "line 1: there is no section [Spring]"),
        ("[Springs]\nfriction = 1", "line 2: there is no `friction` in section [Springs]"),
        ("stiffness = 1", "line 1: there is no `stiffness` in section []"),
        ("[Springs]\n\nstiffness = much", "line 3: `stiffness` is `much`, expected a number, N/m"),
        ("[Springs]\nstiffness", "line 2: `stiffness`, expected `name = value` or `[Section]`"),
        ("[Integration]\nmethod = verlet", "line 2: `method` is `verlet`, expected euler, multi, midpoint or rk4"),
    ] {
        assert_eq!(Constants::from_ini(text).unwrap_err().to_string(), expected);
    }
}

#[test]
fn constants_out_of_range_are_rejected() {
    let block = named("block").unwrap();
    for text in [
        "[Simulation]\nmid_loop_count = 0",
        "[Springs]\nstiffness = -1",
        "[Springs]\nstiffness = NaN",
        "[Contact]\nrestitution = 1.5",
        "[Simulation]\nframe_rate = inf",
    ] {
        let error = Jenga3D::new(&block, Constants::from_ini(text).unwrap()).unwrap_err().to_string();
        assert!(error.contains("expected"), "{error}");
    }
}
