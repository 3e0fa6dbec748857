//! Interruption and outputs that cannot be written: nothing is left half-written, nothing panics,
//! and what is printed cannot change a terminal.
#![cfg(unix)]

use std::fs::OpenOptions;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{command, teeter, teeter_with};

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn an_interrupted_command_leaves_no_file_and_what_was_there() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let folder = tempfile::tempdir().unwrap();
        let (out, trace) = (folder.path().join("end.json"), folder.path().join("trace.csv"));
        std::fs::write(&out, "old").unwrap();
        let args = ["run", "tower", "--seconds", "3600", "--no-sleep"];
        let files = ["--out", out.to_str().unwrap(), "--trace", trace.to_str().unwrap()];
        let mut child = command(&[&args[..], &files[..]].concat()).spawn().unwrap();
        // Both files are being written.
        while names(folder.path()).len() < 3 {
            assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
            std::thread::yield_now();
        }
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(code));
        assert_eq!(names(folder.path()), ["end.json"]);
        assert_eq!(std::fs::read(&out).unwrap(), b"old");
    }
}

/// Exit code of the program where standard error is full.
fn code_without_stderr(args: &[&str], input: &str) -> Option<i32> {
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut child = command(args).stdin(Stdio::piped()).stderr(full).spawn().unwrap();
    let _ = std::io::Write::write_all(&mut child.stdin.take().unwrap(), input.as_bytes());
    child.wait_with_output().unwrap().status.code()
}

#[test]
fn a_full_standard_error_is_no_panic() {
    let block = r#"{"id": 0, "size": [0.1, 0.1, 0.1], "mass": 1, "pos": [0, 0, 0.05]}"#;
    // A coefficient of restitution that contacts cannot have is a warning.
    let scene = format!(r#"{{"name": "one", "friction": 0.4, "restitution": 1, "blocks": [{block}]}}"#);
    let run = ["run", "-", "--seconds", "0.1"];
    assert!(teeter_with(&run, scene.as_bytes()).err.starts_with("warning: "));
    assert_eq!(code_without_stderr(&run, &scene), Some(0));
    // Errors keep their exit code.
    assert_eq!(code_without_stderr(&run, "{"), Some(2));
    assert_eq!(code_without_stderr(&["run", "--nonsense"], ""), Some(2));
    assert_eq!(code_without_stderr(&[], ""), Some(2));
    // A report that cannot be written is an error.
    assert_eq!(code_without_stderr(&["run", "block", "--seconds", "0.1", "--out", "-"], ""), Some(2));
}

#[test]
fn names_cannot_change_a_terminal() {
    let name = r"a\u001b[31m\u009b2J\u202eb\u0007";
    let block = r#"{"id": 0, "size": [0.1, 0.1, 0.1], "mass": 1, "pos": [0, 0, 0.05]}"#;
    let scene = format!(r#"{{"name": "{name}", "friction": 0.4, "restitution": 1, "blocks": [{block}]}}"#);
    let hidden = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    for args in [
        &["run", "-", "--seconds", "0.1"][..],
        &["run", "-", "--seconds", "0.1", "--json"],
        &["run", "-", "--seconds", "0.1", "--out", "-"],
        &["forces", "-"],
        &["forces", "-", "--json"],
        &["score", "-"],
        &["score", "-", "--json"],
    ] {
        let done = teeter_with(args, scene.as_bytes());
        assert_eq!(done.code, 0, "{args:?}: {}", done.err);
        assert!(!done.out.contains(hidden) && !done.err.contains(hidden), "{args:?}: {:?} {:?}", done.out, done.err);
    }
    // The path of a report that is printed at the end.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a\u{1b}[31mb");
    let done = teeter(&["dissertation", "report", "--only", "nothing", "--out", path.to_str().unwrap()]);
    assert!(!done.err.contains(hidden), "{:?}", done.err);
}

#[test]
fn more_scenes_than_are_read() {
    let scene = r#"{"name":"a","friction":0,"blocks":[{"id":0,"size":[1,1,1],"mass":1,"pos":[0,0,0.5]}]}"#;
    let text = format!("{scene}\n").repeat(100_001);
    let done = teeter_with(&["score", "-"], text.as_bytes());
    let expected = "standard input, line 100001: more than 100000 scenes or 2000000 blocks in all, the most that is read: divide the file";
    assert_eq!(done.error_line(), expected);
}
