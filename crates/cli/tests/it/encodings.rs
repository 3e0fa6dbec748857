//! Files as other programs write them: compressed, with a byte order mark, in UTF-16.

use std::io::Write;
use std::path::Path;

use crate::common::teeter;
use flate2::Compression;
use flate2::write::GzEncoder;
use teeter_scene::named;

/// The text in each encoding, with the name of it.
fn encodings(text: &str) -> Vec<(&'static str, Vec<u8>)> {
    let utf16 = |unit: fn(u16) -> [u8; 2]| format!("\u{feff}{text}").encode_utf16().flat_map(unit).collect::<Vec<u8>>();
    let gzip = |bytes: &[u8]| {
        let mut packer = GzEncoder::new(Vec::new(), Compression::fast());
        packer.write_all(bytes).unwrap();
        packer.finish().unwrap()
    };
    vec![
        ("plain", text.into()),
        ("marked", format!("\u{feff}{text}").into()),
        ("little", utf16(u16::to_le_bytes)),
        ("big", utf16(u16::to_be_bytes)),
        ("gzip", gzip(text.as_bytes())),
        ("gzip-little", gzip(&utf16(u16::to_le_bytes))),
    ]
}

/// Calls `check` with the path of a file of `text` in each encoding.
fn each(text: &str, check: impl Fn(&str, &Path)) {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in encodings(text) {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        check(name, &path);
    }
}

#[test]
fn a_scene_can_be_in_each_encoding() {
    let hash = teeter(&["run", "test-5", "--seconds", "0.1", "--json"]).json()["hash"].clone();
    each(&named("test-5").unwrap().to_json(), |name, path| {
        let report = teeter(&["run", path.to_str().unwrap(), "--seconds", "0.1", "--json"]).json();
        assert_eq!(report["hash"], hash, "{name}");
    });
}

#[test]
fn inputs_can_be_in_each_encoding() {
    each("{\"time\": 0}\r\n{\"time\": 1, \"wind\": 0}\r\n", |name, path| {
        let done = teeter(&["run", "block", "--inputs", path.to_str().unwrap()]);
        assert!(done.error_line().contains(", line 2: `wind` is not a field of a change"), "{name}: {}", done.err);
    });
}

#[test]
fn labelled_scenes_can_be_in_each_encoding() {
    let scene = named("test-4").unwrap().to_json();
    each(&format!("{scene}\r\n{scene}\r\n"), |name, path| {
        let summary = teeter(&["score", path.to_str().unwrap(), "--json"]).json();
        assert_eq!((&summary["scenes"], &summary["config"]["right"]), (&2.into(), &2.into()), "{name}");
    });
}

#[test]
fn a_data_sheet_can_be_in_each_encoding() {
    let sheet = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/data-sheet.csv");
    let folder = tempfile::tempdir().unwrap();
    each(&std::fs::read_to_string(sheet).unwrap(), |name, path| {
        let out = folder.path().to_str().unwrap();
        let done = teeter(&["validate", "--quick", "--out", out, "--real", path.to_str().unwrap()]);
        assert_eq!(done.error_line(), "the data sheet has no pulls to compare", "{name}");
    });
}

#[test]
fn files_that_are_no_text_are_refused_by_their_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("photo.jpg");
    std::fs::write(&path, b"\xff\xd8\xff\xe0 photo").unwrap();
    let path = path.to_str().unwrap();
    let done = teeter(&["run", "block", "--inputs", path]);
    assert!(
        done.error_line().ends_with("photo.jpg: this is not text: byte 0 is neither UTF-8 nor UTF-16"),
        "{}",
        done.err
    );
    for args in [&["run", path][..], &["score", path], &["validate", "--out", path, "--real", path]] {
        assert!(teeter(args).error_line().contains("photo.jpg"));
    }
}

/// Errors of a line of many name the line of the file, not that of the line.
#[test]
fn errors_of_labelled_scenes_have_one_line_number() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scenes.jsonl");
    let scene = named("block").unwrap().to_json();
    std::fs::write(&path, format!("{scene}\n{}\n", scene.replace("mass", "mas"))).unwrap();
    let done = teeter(&["score", path.to_str().unwrap()]);
    let expected = "scenes.jsonl, line 2: block 0: `mas` is not a field of a block: did you mean `mass`? (line 2, ";
    assert!(done.error_line().contains(expected), "{}", done.err);
    std::fs::write(&path, scene.replace("\"name\"", "\"truth\": {\"tilt_deg\": \"flat\"}, \"name\"")).unwrap();
    let done = teeter(&["score", path.to_str().unwrap()]);
    let expected = "line 1: `truth` is not an object with `tilt_deg`, a number, and `side_sensitive`, true or false";
    assert!(done.error_line().ends_with(expected), "{}", done.err);
}
