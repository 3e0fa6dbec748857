//! Bad input: exit code 2, nothing on standard output, and one line on standard error that names
//! the cause.

use std::fs::File;
use std::io::Write;

use crate::common::{command, teeter, teeter_with};
use serde_json::{Value, json};

fn good() -> Value {
    json!({"name": "two", "friction": 0.4, "blocks": [
        {"id": 7, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.009], "yaw": 0.0},
        {"id": 9, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0.0, 0.0, 0.027], "yaw": 0.0}]})
}

/// Error line of `run` for the good scene after `spoil`.
fn error_of(spoil: impl FnOnce(&mut Value)) -> String {
    let mut scene = good();
    spoil(&mut scene);
    teeter_with(&["run", "-", "--seconds", "0.1", "--json"], scene.to_string().as_bytes()).error_line().to_owned()
}

fn without(value: &mut Value, field: &str) {
    value.as_object_mut().unwrap().remove(field).unwrap();
}

#[test]
fn the_good_scene_runs() {
    let report = teeter_with(&["run", "-", "--seconds", "0.1", "--json"], good().to_string().as_bytes()).json();
    assert_eq!(report["stands"], true);
}

#[test]
fn each_field_missing() {
    for field in ["name", "friction", "blocks"] {
        let error = error_of(|s| without(s, field));
        assert!(error.starts_with(&format!("standard input: missing field `{field}`")), "{error}");
    }
    for field in ["size", "mass", "pos"] {
        let error = error_of(|s| without(&mut s["blocks"][1], field));
        assert!(error.starts_with(&format!("standard input: block 9: missing field `{field}`")), "{error}");
    }
    let error = error_of(|s| without(&mut s["blocks"][1], "id"));
    assert!(error.starts_with("standard input: block at index 1 of the list: missing field `id`"), "{error}");
}

#[test]
fn not_a_number() {
    for (field, bad) in
        [("mass", json!(null)), ("mass", json!("NaN")), ("pos", json!([0, null, 0.027])), ("size", json!([null, 1, 1]))]
    {
        let error = error_of(|s| s["blocks"][1][field] = bad);
        assert!(error.starts_with(&format!("standard input: block 9: `{field}")), "{error}");
    }
    let text = good().to_string();
    for bad in ["1e999", "-1e999", "NaN", "Infinity"] {
        let done = teeter_with(&["run", "-"], text.replacen("0.0196", bad, 1).as_bytes());
        done.error_line();
    }
}

#[test]
fn impossible_blocks() {
    assert!(
        error_of(|s| s["blocks"][0]["size"][1] = json!(0))
            .contains("block 7: `size` is [0.081, 0, 0.018] m, expected three lengths of")
    );
    assert!(error_of(|s| s["blocks"][0]["size"][1] = json!(-0.02)).contains("block 7: `size`"));
    assert!(error_of(|s| s["blocks"][0]["mass"] = json!(0)).contains("block 7: `mass` is 0 kg, expected above 0"));
    assert!(error_of(|s| s["blocks"][1]["id"] = json!(7)).contains("block 7: `id` is used twice"));
    assert!(
        error_of(|s| s["blocks"][1]["pos"][2] = json!(0.020))
            .contains("blocks 7 and 9: `pos` makes them overlap by 7.000 mm")
    );
    assert!(error_of(|s| s["blocks"][0]["pos"][2] = json!(0.0)).contains("block 7: `pos` is 0.000 mm above the floor"));
    assert!(error_of(|s| s["blocks"] = json!([])).contains("`blocks` is a list of 0"));
    assert!(error_of(|s| s["friction"] = json!(3)).contains("`friction` is 3, expected 0 to 2"));
    assert!(error_of(|s| s["stiffness"] = json!(1)).contains("`stiffness` is 1, expected 1e4 to 1e8 N/m"));
    assert!(error_of(|s| s["gravity"] = json!(-9.81)).contains("`gravity` is -9.81, expected 0 to 100 m/s²"));
}

/// A sparse file of 4 TB takes no room on most disks, and a program that reads it all runs for
/// hours.
#[test]
fn a_huge_file_is_refused_before_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.json");
    // Other systems than Unix may set the room aside.
    let size = if cfg!(unix) { 4 << 40 } else { 2 << 30 };
    File::create(&path).unwrap().set_len(size).unwrap();
    let path = path.to_str().unwrap();
    for command in ["run", "score"] {
        let error = teeter(&[command, path]).error_line().to_owned();
        assert!(error.contains("larger than"), "{error}");
    }
    let done = command(&["run", "-"]).stdin(File::open(path).unwrap()).output().unwrap();
    assert_eq!(done.status.code(), Some(2));
    assert!(String::from_utf8(done.stderr).unwrap().contains("larger than 64 MB"));
}

#[test]
fn a_packed_flood_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flood.jsonl.gz");
    let mut packer = flate2::write::GzEncoder::new(File::create(&path).unwrap(), flate2::Compression::fast());
    let blanks = vec![b' '; 1 << 20];
    for _ in 0..100 {
        packer.write_all(&blanks).unwrap();
    }
    packer.finish().unwrap();
    let done = teeter(&["score", path.to_str().unwrap()]);
    assert!(
        done.error_line().ends_with("flood.jsonl.gz, line 1: the scene is larger than 64 MB, the most that is read"),
        "{}",
        done.err
    );
}

#[test]
fn no_scene_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().to_str().unwrap();
    assert!(teeter(&["run", folder]).error_line().ends_with(": this is a folder, expected a file"));
    assert!(
        teeter(&["run", &format!("{folder}/none.json")]).error_line().ends_with("none.json: there is no such file")
    );
    assert!(
        teeter(&["score", &format!("{folder}/none.jsonl")]).error_line().ends_with("none.jsonl: there is no such file")
    );
    assert!(
        teeter(&["run", "nosuch"])
            .error_line()
            .starts_with("there is no scene `nosuch`, neither a file nor one of tower, ")
    );
    assert_eq!(teeter_with(&["run", "-"], b"").error_line(), "standard input: the scene is empty, expected JSON");
    assert!(
        teeter_with(&["run", "-"], b"two blocks, please")
            .error_line()
            .starts_with("standard input: this is not JSON: expected")
    );
    assert!(
        teeter_with(&["run", "-"], b"[1, 2]")
            .error_line()
            .starts_with("standard input: the scene is a JSON list, expected a JSON object")
    );
    assert_eq!(
        teeter_with(&["run", "-"], b"{\"name\": \"\xff\"}").error_line(),
        "standard input: the scene is not text: byte 10 is not UTF-8"
    );
    assert!(teeter_with(&["score", "-"], b"\n\n").error_line().starts_with("standard input: no scenes"));
}

#[test]
fn errors_among_many_scenes_name_the_line() {
    let mut bad = good();
    bad["blocks"][0]["mass"] = json!(-1);
    let lines = format!("{}\n\n{bad}\n", good());
    let done = teeter_with(&["score", "-"], lines.as_bytes());
    assert_eq!(
        done.error_line(),
        "standard input, line 3: block 7: `mass` is -1 kg, expected above 0 and at most 10000 kg"
    );
}

#[test]
fn commands_that_are_none() {
    for (args, found) in [
        (&["frobnicate"][..], "frobnicate"),
        (&["run"], "<SCENE>"),
        (&["run", "tower", "--secnds", "3"], "--secnds"),
        (&["run", "tower", "--seconds", "NaN"], "NaN"),
        (&["run", "tower", "--seconds", "0"], "'0'"),
        (&["run", "tower", "--stiffness", "1e3"], "1e3"),
        (&["run", "tower", "--precision", "half"], "half"),
        (&["run", "tower", "--seconds", "-1"], "'-1' for '--seconds <SECONDS>': expected a number from 0.02 to 86400"),
        (&["scene", "tower", "--edge-radius", "-1"], "'-1' for '--edge-radius <MM>': expected a number from 0 to 10"),
        (&["scene", "tower", "--rows", "0"], "'0'"),
        (&["scene", "tower", "--rows", "201"], "201"),
        (&["scene", "tower", "--block", "lego"], "lego"),
        (&["scene", "tower", "--height-sd", "-1"], "-1"),
        (&["scene", "config"], "--config"),
        (&["scene", "config", "--config", "(01)"], "row 1 of the configuration is `(01)`"),
        (&["scene", "nosuch"], "nosuch"),
        (&["scene", "midgame", "pile"], "pile"),
        (&["scene", "midgame", "--stiffness", "stiff"], "stiff"),
        (&["scene", "tower", "--stiffness", "1e9"], "1e9"),
        (
            &["scene", "tower", "--kinetic-friction", "0.5"],
            "`kinetic_friction` is 0.5, expected at most `friction`, 0.4",
        ),
        (&["score", "/dev/null", "--out", "/no/such/folder"], "no scenes"),
    ] {
        let done = teeter(args);
        assert!(done.error_line().contains(found), "{args:?}: {}", done.err);
    }
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let mut child = command(&["scene", "tower", "--rows", "200"]).spawn().unwrap();
    drop(child.stdout.take());
    let done = child.wait_with_output().unwrap();
    assert_eq!((done.status.code(), done.stderr.as_slice()), (Some(0), &b""[..]));
}
