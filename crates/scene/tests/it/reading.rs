//! Reading: compressed and encoded text, limits, and text that is not JSON.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;
use proptest::prelude::*;
use teeter_scene::{Scene, SceneError, named, printable, read_text};

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// The text in every encoding that is read.
fn encodings(text: &str) -> Vec<(&'static str, Vec<u8>)> {
    let utf16 = |text: &str, unit: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(unit).collect::<Vec<u8>>();
    let marked = format!("\u{feff}{text}");
    vec![
        ("UTF-8", text.into()),
        ("UTF-8 with a mark", marked.clone().into()),
        ("UTF-16, low byte first", utf16(text, u16::to_le_bytes)),
        ("UTF-16, high byte first", utf16(text, u16::to_be_bytes)),
        ("UTF-16 with a mark, low byte first", utf16(&marked, u16::to_le_bytes)),
        ("UTF-16 with a mark, high byte first", utf16(&marked, u16::to_be_bytes)),
    ]
}

/// Reader that returns one byte at a time.
struct Slow<'a>(&'a [u8]);

impl std::io::Read for Slow<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let Some((first, rest)) = self.0.split_first() else { return Ok(0) };
        buffer[0] = *first;
        self.0 = rest;
        Ok(1)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_encoding_is_read_as_the_same_text(rest in "[^\u{feff}\u{0}]{0,40}") {
        let text = format!("{{{rest}");
        for (encoding, bytes) in encodings(&text) {
            prop_assert_eq!(read_text(&bytes[..], 1000), Ok(text.clone()), "{}", encoding);
            prop_assert_eq!(read_text(&gzip(&bytes)[..], 1000), Ok(text.clone()), "{}, compressed", encoding);
            prop_assert_eq!(read_text(Slow(&bytes), 1000), Ok(text.clone()), "{}, a byte at a time", encoding);
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        if let Ok(text) = read_text(&bytes[..], 1000) {
            let _ = Scene::from_json(&text);
        }
    }

    #[test]
    fn any_text_of_json_characters_is_one_clear_line(text in r#"[\[\]{}:,"a-z0-9. \n\-]{0,60}"#) {
        let error = Scene::from_json(&text).unwrap_err().to_string();
        prop_assert!(!error.contains('\n'), "{}", error);
    }

    #[test]
    fn printable_text_has_no_control_characters(text in any::<String>()) {
        let clean = printable(&text);
        prop_assert_eq!(clean.chars().count(), text.chars().count());
        prop_assert!(!clean.chars().any(char::is_control));
        prop_assert_eq!(printable(&clean), clean);
    }
}

#[test]
fn characters_beyond_sixteen_bits_survive_the_boundary_of_a_chunk() {
    for offset in 0..3 {
        let text = format!("{{{}{}", "a".repeat(offset), "\u{1f3d7}é".repeat(60_000));
        let bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(read_text(&bytes[..], 1_000_000).unwrap() == text, "{offset}");
    }
}

#[test]
fn a_scene_is_read_from_a_compressed_file() {
    let scene = named("column").unwrap();
    let packed = gzip(scene.to_json().as_bytes());
    assert_eq!(Scene::read(&packed[..], 1_000_000).unwrap(), scene);
    let error = Scene::read(&packed[..packed.len() / 2], 1_000_000).unwrap_err().to_string();
    assert_eq!(error, "the scene cannot be read: its end is missing");
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    assert_eq!(read_text(&b"{\"name\": \"\xff\"}"[..], 100), Err(SceneError::NotUtf8(10)));
    assert_eq!(
        read_text(&b"\xff\xfe{\0\x00\xd8{\0"[..], 100).unwrap_err().to_string(),
        "the scene cannot be read: it is no valid UTF-16"
    );
    assert_eq!(
        read_text(&b"\xff\xfe{\0}"[..], 100).unwrap_err().to_string(),
        "the scene cannot be read: its end is missing"
    );
}

#[test]
fn reading_stops_at_the_limit() {
    let text = named("column").unwrap().to_json();
    assert!(Scene::read(text.as_bytes(), text.len() as u64).is_ok());
    assert_eq!(Scene::read(text.as_bytes(), text.len() as u64 - 1), Err(SceneError::TooLarge { limit_mb: 0 }));
    assert_eq!(Scene::read(std::io::repeat(b' '), 3_000_000), Err(SceneError::TooLarge { limit_mb: 3 }));
}

/// A small compressed file may hold any amount of text.
#[test]
fn the_limit_holds_for_the_unpacked_text() {
    let packed = gzip(&vec![b' '; 8_000_000]);
    assert!(packed.len() < 100_000);
    assert_eq!(Scene::read(&packed[..], 3_000_000), Err(SceneError::TooLarge { limit_mb: 3 }));
    let text = read_text(&packed[..], 8_000_000).unwrap();
    assert_eq!((text.len(), text.capacity()), (8_000_000, 8_000_000));
}

#[test]
fn text_in_the_manner_of_other_languages_gets_a_hint() {
    for (text, hint) in [
        ("{\"name\": NaN}", "JSON has no NaN"),
        ("{\"name\": nan}", "JSON has no NaN"),
        ("{\"gravity\": Infinity}", "JSON has no Infinity"),
        ("{\"gravity\": -Infinity}", "JSON has no Infinity"),
        ("{\"blocks\": [{\"id\": 3, \"fixed\": True}]}", "JSON writes true"),
        ("{\"label\": None}", "JSON writes null"),
        ("{'name': 'a'}", "JSON has double quotation marks"),
        ("{\"name\": 'a'}", "JSON has double quotation marks"),
        ("{\n// the name\n\"name\": \"a\"}", "JSON has no comments"),
        ("{\"gravity\": 9.81, // down\n\"name\": \"a\"}", "JSON has no comments"),
        ("# a scene\n{}", "JSON has no comments"),
        ("{\"name\": \"a\",}", "a comma is followed by no value"),
        ("{\"blocks\": [{\"id\": 1, \"size\": [1, 2, 3,]}]}", "a comma is followed by no value"),
        ("{name: 1}", "the name of a field must be in double quotation marks"),
        ("{\"gravity\": .5}", "a digit before the point"),
        ("{\"gravity\": +5}", "no plus sign"),
        ("<html>", "XML"),
    ] {
        let error = Scene::from_json(text).unwrap_err().to_string();
        assert!(error.starts_with("this is not JSON: ") && error.contains(hint), "{text}: {error}");
    }
}
