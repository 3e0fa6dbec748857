//! `teeter dissertation`: the report's page holds what was asked for, and a run has its constants.

use crate::common::{teeter, teeter_with};

#[test]
fn parts_of_the_report() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new").join("report");
    let done = teeter(&[
        "dissertation",
        "report",
        "--out",
        out.to_str().unwrap(),
        "--only",
        "table-5.2",
        "--only",
        "soft-springs",
    ]);
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert_eq!(done.out.trim_end(), out.join("index.html").display().to_string());
    // Twice 168 n (n - 1) for 18, 27 and 54 blocks: printed, and counted.
    for count in ["102816", "235872", "961632"] {
        assert!(page.matches(&format!("<td>{count}</td>")).count() >= 2, "{count}");
    }
    assert_eq!(page.matches("<h2>").count(), 2);
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 3);
}

/// Constants of an ini file change the figures of a part, which names them. A part of an earlier
/// run keeps the note of its own.
#[test]
fn a_report_has_the_constants_of_an_ini_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("soft.ini");
    let file = path.to_str().unwrap();
    let report = |part: &str, options: &[&str]| {
        let base = ["dissertation", "report", "--out", folder.path().to_str().unwrap(), "--only", part];
        let done = teeter(&[&base, options].concat());
        assert_eq!((done.code, done.err.as_str()), (0, ""));
        std::fs::read_to_string(folder.path().join("index.html")).unwrap()
    };
    std::fs::write(&path, "[Springs]\nstiffness = 5000\n").unwrap();
    let page = report("fewer-springs", &["--ini", file]);
    let note = "With constants other than the defaults: stiffness = 5000 N/m (default 10000).";
    assert_eq!(page.matches(note).count(), 1, "{page}");
    let with_default = report("step-size", &[]);
    assert_eq!(with_default.matches("other than the defaults").count(), 1);
    assert!(with_default.contains("<td>30</td><td>104</td>"), "{with_default}");
    let figures = |page: &str| {
        let section = page.split("<section id=\"fewer-springs\">").nth(1).unwrap();
        section.split("</section>").next().unwrap().split("</thead>").nth(1).unwrap().to_owned()
    };
    let default = report("fewer-springs", &[]);
    assert_ne!(figures(&default), figures(&page));
    assert!(!default.contains("other than the defaults"), "{default}");
    for (text, part) in [
        ("[Simulation]\nframe_rate = 30", "`frame_rate` is 30, expected 60"),
        ("[Springs]\nstiffness = 0", "soft.ini, line 2: `stiffness` is 0, expected a number from 1"),
    ] {
        std::fs::write(&path, text).unwrap();
        let done = teeter(&["dissertation", "report", "--out", folder.path().to_str().unwrap(), "--ini", file]);
        assert!(done.error_line().contains(part), "{}", done.err);
    }
    assert_eq!(std::fs::read_to_string(folder.path().join("index.html")).unwrap(), default);
}

#[test]
fn bad_input_ends_with_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    std::fs::write(&file, "").unwrap();
    let under_a_file = file.join("report");
    let done = teeter(&["dissertation", "report", "--out", under_a_file.to_str().unwrap()]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1));
    assert!(done.err.contains("this folder cannot be made"), "{}", done.err);
    let done = teeter(&["dissertation", "report", "--out", "x", "--only", "chapter-9"]);
    assert_eq!((done.code, done.err.lines().count()), (2, 1), "{}", done.err);
    assert!(done.err.contains("chapter-9"));
    assert_eq!(teeter(&["dissertation", "report"]).code, 2);
}

/// Figures of a short run that a person would compare.
#[test]
fn a_run_reports_its_figures() {
    let done = teeter(&["dissertation", "run", "tower", "--rows", "3", "--seconds", "3", "--json"]).json();
    assert_eq!((&done["stands"], &done["rows"], &done["blocks"]), (&true.into(), &3.into(), &9.into()));
    assert_eq!((&done["frames"], &done["calls"]), (&180.into(), &(180 * 160 * 2).into()));
    for (name, max) in [("max_displacement_mm", 1.0), ("creep_mm", 0.5), ("sink_mm", 0.5), ("mean_rounds", 3.0)] {
        assert!((0.0..max).contains(&done[name].as_f64().unwrap()), "{name}: {}", done[name]);
    }
    assert!(done["frames_per_s"].as_f64().unwrap() > 0.0 && done["cpu_s"].as_f64().unwrap() > 0.0);
    let by_rounds: u64 = done["calls_by_rounds"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).sum();
    assert_eq!(by_rounds, done["calls"].as_u64().unwrap());
    assert_eq!(done["hash"].as_str().unwrap().len(), 16);
    let text = teeter(&["dissertation", "run", "tower", "--rows", "3", "--seconds", "3"]).out;
    assert!(text.contains("stands") && text.contains(done["hash"].as_str().unwrap()), "{text}");
    let fallen = teeter(&["dissertation", "run", "test-4", "--seconds", "2", "--json"]).json();
    assert_eq!(fallen["stands"], false);
    assert_ne!(fallen["fell"], serde_json::json!([]));
}

/// A scene from standard input is that of the list.
#[test]
fn a_run_takes_a_scene_from_anywhere() {
    let scene = teeter(&["scene", "test-5"]).out;
    let piped = teeter_with(&["dissertation", "run", "-", "--seconds", "0.1", "--json"], scene.as_bytes()).json();
    let named = teeter(&["dissertation", "run", "test-5", "--seconds", "0.1", "--json"]).json();
    assert_eq!(piped["hash"], named["hash"]);
}

/// Every option reaches the simulator: it changes the state, or the count of tests it governs.
#[test]
fn options_change_the_run() {
    let run = |options: &[&str]| {
        let base = ["dissertation", "run", "test-6", "--seconds", "0.3", "--json"];
        teeter(&[&base, options].concat()).json()["hash"].clone()
    };
    let default = run(&[]);
    for options in [
        &["--method", "euler"][..],
        &["--method", "midpoint"],
        &["--method", "rk4"],
        &["--no-friction"],
        &["--static-friction", "0.4"],
        &["--disabling", "off"],
        &["--disabling", "rigid-motion"],
        &["--order", "top-down"],
        &["--springs", "faces"],
        &["--stiffness", "5e3"],
        &["--mid-loop-count", "200"],
        &["--set", "drag=0"],
        &["--set", "restitution=0.3", "--set", "max_sweeps=3"],
    ] {
        assert_ne!(run(options), default, "{options:?}");
    }
    for options in [
        &["--method", "multistep"][..],
        &["--culling", "off"],
        &["--culling", "on"],
        &["--no-static-friction"],
        &["--disabling", "listed"],
        &["--springs", "all"],
        &["--set", "stiffness=1e4"],
    ] {
        assert_eq!(run(options), default, "{options:?}");
    }
}

/// The file that is written gives the same run, and an option has priority over it.
#[test]
fn a_written_ini_file_gives_the_same_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("jenga.ini");
    let file = path.to_str().unwrap();
    let written = teeter(&["dissertation", "run", "--write-ini", file]);
    assert_eq!((written.code, written.out.as_str(), written.err.as_str()), (0, format!("{file}\n").as_str(), ""));
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("N/m") && text.contains("stiffness = 10000"), "{text}");
    assert_eq!(teeter(&["dissertation", "run", "--write-ini", "-"]).out, text);

    let base = ["dissertation", "run", "test-5", "--seconds", "0.2", "--json"];
    let hash = |options: &[&str]| teeter(&[&base, options].concat()).json()["hash"].clone();
    assert_eq!(hash(&["--ini", file]), hash(&[]));
    assert_ne!(hash(&["--ini", file, "--stiffness", "5e3"]), hash(&[]));
    std::fs::write(&path, text.replace("stiffness = 10000", "stiffness = 5000")).unwrap();
    assert_eq!(hash(&["--ini", file]), hash(&["--stiffness", "5000"]));
    let merged = teeter(&["dissertation", "run", "--ini", file, "--write-ini", "-"]).out;
    assert!(merged.contains("\nstiffness = 5000\n"), "{merged}");
}

/// Odd constants end with one line that names the field, its value and what is allowed.
#[test]
fn odd_constants_end_with_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("odd.ini");
    let file = path.to_str().unwrap();
    for (text, parts) in [
        (
            "[Friction]\nstatic_friction = -1",
            &["odd.ini, line 2: `static_friction` is -1, expected none or a number from 0"][..],
        ),
        ("[Springs]\nstiffness = 1e6", &["test-1: `stiffness` is 1e6, expected at most ", " N/m"]),
        ("[Friction]\ndrag = NaN", &["line 2: `drag` is NaN, expected a number from 0 to 100 N s/m"]),
        (
            "[Simulation]\nmid_loop_count = 4294967295",
            &["`mid_loop_count` is 4294967295, expected a whole number from 1"],
        ),
        ("[Contact]\nmax_sweeps = 0", &["`max_sweeps` is 0, expected a whole number from 1 to 1000"]),
        ("[Simulation]\nmid_loop_count = 8", &["`mid_loop_count` is 8, expected at least "]),
        ("[Integration]\nmethod = verlet", &["`method` is `verlet`, expected euler, multistep, midpoint or rk4"]),
    ] {
        std::fs::write(&path, text).unwrap();
        let done = teeter(&["dissertation", "run", "test-1", "--seconds", "0.1", "--ini", file]);
        for part in parts {
            assert!(done.error_line().contains(part), "{text}: {}", done.err);
        }
    }
    for (options, part) in [
        (&["--set", "stiffness"][..], "expected NAME=VALUE"),
        (&["--set", "tension=1"], "there is no constant `tension`"),
        (&["--set", "drag=-1"], "`drag` is -1, expected a number from 0 to 100 N s/m"),
        (&["--stiffness", "-5"], "`stiffness` is -5, expected a number from 1"),
        (&["--method", "verlet"], "verlet"),
        (&["--rows", "3"], "--rows is that of the scene `tower`"),
        (&["--seconds", "0"], "expected a number from 0.02"),
        (&["--ini", "no-such.ini"], "no-such.ini: there is no such file"),
        (&["--write-ini", "/no/such/folder/x.ini"], "there is no such folder"),
    ] {
        let done = teeter(&[&["dissertation", "run", "test-1"], options].concat());
        assert!(done.error_line().contains(part), "{options:?}: {}", done.err);
    }
    let fixed = teeter(&["dissertation", "run", "slope"]);
    assert!(fixed.error_line().contains("no fixed blocks"), "{}", fixed.err);
}
