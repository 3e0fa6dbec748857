//! `teeter run --trace`: a row a frame and block, the same in each format.

use std::fs::File;
use std::path::Path;

use crate::common::{teeter, teeter_with};
use glam::DQuat;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, RowAccessor};
use serde_json::Value;

const COLUMNS: [&str; 17] = [
    "time_s",
    "id",
    "position_x_m",
    "position_y_m",
    "position_z_m",
    "orientation_x",
    "orientation_y",
    "orientation_z",
    "orientation_w",
    "velocity_x_m_s",
    "velocity_y_m_s",
    "velocity_z_m_s",
    "spin_x_rad_s",
    "spin_y_rad_s",
    "spin_z_rad_s",
    "asleep",
    "quarantined",
];

/// A row as JSON values in the order of the columns.
type Row = Vec<Value>;

/// Runs a scene for some seconds with a trace in this format, and returns its path.
fn trace(folder: &Path, format: &str, scene: &str, args: &[&str]) -> std::path::PathBuf {
    let path = folder.join(format!("trace.{format}"));
    let done = teeter(&[&["run", scene, "--ramp", "0", "--trace", path.to_str().unwrap()], args].concat());
    assert_eq!((done.code, done.err.as_str()), (0, ""));
    path
}

fn parquet_rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let value = |field: &Field| match field {
        Field::Double(x) => Value::from(*x),
        Field::UInt(x) => Value::from(*x),
        Field::Bool(x) => Value::from(*x),
        other => panic!("{other}"),
    };
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| row.unwrap().get_column_iter().map(|(_, field)| value(field)).collect()).collect()
}

fn json_rows(path: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line| {
        let value: Value = serde_json::from_str(line).unwrap();
        assert_eq!(value.as_object().unwrap().len(), COLUMNS.len());
        COLUMNS.iter().map(|name| value[name].clone()).collect()
    };
    text.lines().map(row).collect()
}

fn csv_rows(path: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    assert_eq!(reader.headers().unwrap(), &csv::StringRecord::from(COLUMNS.to_vec()));
    let row = |record: csv::StringRecord| record.iter().map(|cell| serde_json::from_str(cell).unwrap()).collect();
    reader.records().map(|record| row(record.unwrap())).collect()
}

#[test]
fn each_format_has_the_same_rows() {
    let folder = tempfile::tempdir().unwrap();
    let args = ["--seconds", "2", "--trace-every", "40"];
    let file = |format| trace(folder.path(), format, "test-4", &args);
    let (parquet, json, csv) = (parquet_rows(&file("parquet")), json_rows(&file("jsonl")), csv_rows(&file("csv")));
    // three blocks at the start and after 40, 80 and 120 frames
    assert_eq!(parquet.len(), 3 * 4);
    assert_eq!(parquet, json);
    assert_eq!(parquet, csv);
    let ids: Vec<u64> = parquet.iter().map(|row| row[1].as_u64().unwrap()).collect();
    assert_eq!(ids[..6], [0, 1, 2, 0, 1, 2]);
    for (i, row) in parquet.iter().enumerate() {
        let time = row[0].as_f64().unwrap();
        assert!((time - (i / 3) as f64 * 40.0 / 60.0).abs() < 1e-9, "{time}");
    }
}

/// A block that falls freely has come down by g t² / 2 at each time of the trace.
#[test]
fn a_trace_follows_a_falling_block() {
    let scene = r#"{"name": "fall \u001b[31m", "friction": 0.4, "restitution": 0.5, "blocks":
        [{"id": 4000000000, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 2], "spin": [0, 0, 1]}]}"#;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fall.parquet");
    let args = ["run", "-", "--ramp", "0", "--seconds", "0.5", "--trace", path.to_str().unwrap()];
    assert_eq!(teeter_with(&args, scene.as_bytes()).code, 0);
    let rows = parquet_rows(&path);
    assert_eq!(rows.len(), 31);
    for row in &rows {
        let number = |name| row[COLUMNS.iter().position(|column| *column == name).unwrap()].as_f64().unwrap();
        let t = number("time_s");
        assert_eq!(number("id"), 4e9);
        assert!((number("position_z_m") - (2.0 - 0.5 * 9.81 * t * t)).abs() < 1e-6, "{row:?}");
        assert!((number("velocity_z_m_s") + 9.81 * t).abs() < 1e-5, "{row:?}");
        assert!((number("spin_z_rad_s") - 1.0).abs() < 1e-6, "{row:?}");
        let orientation = DQuat::from_rotation_z(t);
        assert!((number("orientation_z") - orientation.z).abs() < 1e-6, "{row:?}");
    }
}

/// Readers know scene and steps from the metadata; a long trace has several row groups.
#[test]
fn parquet_has_metadata_and_row_groups() {
    let folder = tempfile::tempdir().unwrap();
    let path = trace(folder.path(), "parquet", "tower", &["--seconds", "20.25", "--trace-every", "1"]);
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let metadata = reader.metadata();
    let notes = metadata.file_metadata().key_value_metadata().unwrap();
    let note = |key: &str| notes.iter().find(|note| note.key == key).unwrap().value.clone().unwrap();
    assert_eq!((note("scene").as_str(), note("teeter_version").as_str()), ("tower", env!("CARGO_PKG_VERSION")));
    for key in ["frame_s", "dt_s"] {
        assert_eq!(note(key).parse::<f64>().unwrap(), 1.0 / 60.0);
    }
    let rows: Vec<i64> = metadata.row_groups().iter().map(|group| group.num_rows()).collect();
    assert_eq!(rows, [65_536, 54 * 1216 - 65_536]);
    let names: Vec<&str> = metadata.file_metadata().schema_descr().columns().iter().map(|c| c.name()).collect();
    assert_eq!(names, COLUMNS);
    let last = reader.get_row_iter(None).unwrap().last().unwrap().unwrap();
    assert!((last.get_double(0).unwrap() - 20.25).abs() < 1e-9);
    // A tower at rest sleeps by then.
    assert_eq!((last.get_uint(1).unwrap(), last.get_bool(15).unwrap(), last.get_bool(16).unwrap()), (53, true, false));
}

#[test]
fn the_format_is_that_of_the_extension() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["trace.txt", "trace"] {
        let path = folder.path().join(name);
        let done = teeter(&["run", "block", "--trace", path.to_str().unwrap()]);
        let expected = format!("{name}: a trace is a file that ends with .parquet, .csv or .jsonl");
        assert!(done.error_line().ends_with(&expected), "{}", done.err);
        assert!(!path.exists());
    }
    let done = teeter(&["run", "block", "--trace-every", "2"]);
    assert!(done.error_line().contains("--trace <FILE>"), "{}", done.err);
}
