//! `teeter render`: pictures and films as files.

use std::fs;
use std::path::Path;

use crate::common::teeter;
use serde_json::json;

/// Draws a scene into a file of a new folder; returns the JSON report and the bytes.
fn render(name: &str, args: &[&str]) -> (serde_json::Value, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let path = path.to_str().unwrap();
    let report = teeter(&[&["render"], args, &["--out", path, "--json"]].concat()).json();
    assert_eq!(report["file"], path);
    // The only file of the folder: nothing is left beside it.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    (report, fs::read(path).unwrap())
}

fn big_endian(bytes: &[u8]) -> u32 {
    u32::from_be_bytes(bytes[..4].try_into().unwrap())
}

#[test]
fn a_png_file_has_its_size_and_view() {
    let (report, bytes) = render("a.png", &["test-5", "--size", "90x60", "--camera", "-90,30,0.5"]);
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!((big_endian(&bytes[16..]), big_endian(&bytes[20..])), (90, 60));
    assert_eq!((&report["pictures"], &report["from_s"], &report["warnings"]), (&json!(1), &json!(0.0), &json!([])));
    assert_eq!(report["azimuth_deg"], -90.0);
    assert_eq!(report["distance_m"], 0.5);
}

#[test]
fn a_gif_file_has_a_picture_for_each_change() {
    let (report, bytes) = render("a.GIF", &["test-4", "--size", "60x40", "--seconds", "0.5", "--fps", "10"]);
    assert_eq!(&bytes[..6], b"GIF89a");
    assert_eq!(bytes[6..10], [60, 0, 40, 0]);
    assert_eq!((&report["pictures"], &report["to_s"]), (&json!(5), &json!(0.4)));
}

/// Boxes of an MP4 file: type and content.
fn boxes(mut bytes: &[u8]) -> Vec<(String, &[u8])> {
    let mut found = Vec::new();
    while bytes.len() >= 8 {
        let length = big_endian(bytes) as usize;
        found.push((String::from_utf8_lossy(&bytes[4..8]).into_owned(), &bytes[8..length]));
        bytes = &bytes[length..];
    }
    found
}

#[test]
fn an_mp4_file_has_a_sample_of_h264_for_each_picture() {
    let (report, bytes) = render("a.mp4", &["test-4", "--size", "64x48", "--seconds", "0.4", "--fps", "25"]);
    assert_eq!(report["pictures"], 10);
    let top = boxes(&bytes);
    assert_eq!(top[0].0, "ftyp");
    let inside = |parent: &'static str, of: &[(String, &'_ [u8])]| -> Vec<u8> {
        of.iter().find(|(kind, _)| kind == parent).unwrap_or_else(|| panic!("{parent} is missing")).1.to_vec()
    };
    let mut content = inside("moov", &top);
    for kind in ["trak", "mdia", "minf", "stbl"] {
        content = inside(kind, &boxes(&content));
    }
    let table = boxes(&content);
    assert_eq!(&inside("stsd", &table)[12..16], b"avc1");
    // Version and flags, the common size, and the count.
    assert_eq!(big_endian(&inside("stsz", &table)[8..]), 10);
    // The first sample depends on no other one.
    assert_eq!(big_endian(&inside("stss", &table)[8..]), 1);
}

#[test]
fn a_later_picture_shows_the_fallen_tower() {
    let size = ["--size", "90x60"];
    let (_, before) = render("a.png", &[&["test-4"], &size[..]].concat());
    let (report, after) = render("a.png", &[&["test-4", "--at", "1.5"], &size[..]].concat());
    assert_eq!(report["from_s"], 1.5);
    assert_ne!(before, after);
    // The form acts on the future of the tower, and not on the scene as it stands.
    let (_, sprung) = render("a.png", &[&["test-4", "--form", "lattice"], &size[..]].concat());
    assert_eq!(before, sprung);
}

#[test]
fn inputs_move_the_blocks_of_a_film() {
    let folder = tempfile::tempdir().unwrap();
    let inputs = folder.path().join("pull.jsonl");
    fs::write(&inputs, "{\"time\": 0, \"gravity\": [6, 0, -8]}\n").unwrap();
    let args = ["block", "--size", "90x60", "--at", "0.5"];
    let (_, still) = render("a.png", &args);
    let (_, moved) = render("a.png", &[&args[..], &["--inputs", inputs.to_str().unwrap()]].concat());
    assert_ne!(still, moved);
    let (report, _) = render("a.png", &["block", "--size", "90x60", "--inputs", inputs.to_str().unwrap()]);
    assert_eq!(report["warnings"].as_array().unwrap().len(), 1);
}

#[test]
fn bad_input_is_refused_in_a_line_and_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let in_folder = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (png, gif, mp4) = (in_folder("a.png"), in_folder("a.gif"), in_folder("a.mp4"));
    for (args, cause) in [
        (&["tower", "--out", &in_folder("a.jpg")][..], "a picture is a file that ends with .png, a film one with .gif"),
        (&["tower", "--out", &in_folder("a")], "a picture is a file that ends with .png"),
        (&["tower", "--out", "-"], "a picture is a file that ends with .png"),
        (&["tower", "--out", &in_folder("none/a.png")], "cannot be written: there is no such folder"),
        (&["tower"], "--out"),
        (&["nosuch", "--out", &png], "there is no scene `nosuch`"),
        (&[&gif, "--out", &png], "there is no such file"),
        (&["tower", "--out", &png, "--size", "0x720"], "expected WIDTHxHEIGHT, each from 1 to 8192 pixels"),
        (&["tower", "--out", &png, "--size", "1280x8193"], "expected WIDTHxHEIGHT"),
        (&["tower", "--out", &png, "--size", "1280"], "expected WIDTHxHEIGHT"),
        (&["tower", "--out", &mp4, "--size", "1281x720"], "an MP4 film has sides of an even number of pixels"),
        (&["tower", "--out", &gif, "--fps", "60"], "a GIF film has at most 50 pictures a second, not 60"),
        (&["tower", "--out", &png, "--seconds", "3"], "is one picture: --seconds and --fps are for films"),
        (&["tower", "--out", &gif, "--seconds", "0"], "expected a number from 0.02 to 3600"),
        (&["tower", "--out", &png, "--at", "-1"], "expected a number from 0 to 86400"),
        (&["tower", "--out", &png, "--camera", "up"], "expected auto, or AZIMUTH,ELEVATION"),
        (&["tower", "--out", &png, "--camera", "0,-30"], "the elevation is -30, expected 1 to 89 degrees"),
        (&["-", "--out", &png, "--inputs", "-"], "standard input cannot be both"),
    ] {
        let done = teeter(&[&["render"], args].concat());
        assert!(done.error_line().contains(cause), "{args:?}: {}", done.err);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn an_error_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    fs::write(&path, "old").unwrap();
    let scene = folder.path().join("scene.json");
    fs::write(&scene, "{").unwrap();
    let text = |path: &Path| path.to_str().unwrap().to_owned();
    teeter(&["render", &text(&scene), "--out", &text(&path)]).error_line();
    assert_eq!(fs::read(&path).unwrap(), b"old");
}
