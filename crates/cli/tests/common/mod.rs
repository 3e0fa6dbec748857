//! Runs the program as a shell would.
#![allow(dead_code, reason = "each test file uses a part")]

use std::io::Write;
use std::process::{Child, Command, Stdio};

use serde_json::Value;

/// Result of a run of the program.
pub struct Done {
    pub code: i32,
    pub out: String,
    pub err: String,
}

/// The program with these arguments.
pub fn command(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_teeter"));
    command.args(args).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Runs it to its end.
pub fn teeter(args: &[&str]) -> Done {
    done(command(args).spawn().expect("the program starts"))
}

/// Runs it with `input` on standard input.
pub fn teeter_with(args: &[&str], input: &[u8]) -> Done {
    let mut child = command(args).stdin(Stdio::piped()).spawn().expect("the program starts");
    // The program may end before it has read all: a closed pipe is then no failure of the test.
    let _ = child.stdin.take().expect("standard input is piped").write_all(input);
    done(child)
}

fn done(child: Child) -> Done {
    let output = child.wait_with_output().expect("the program ends");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
    Done {
        code: output.status.code().expect("the program ends by itself"),
        out: text(output.stdout),
        err: text(output.stderr),
    }
}

impl Done {
    /// The one JSON object of a run that went well, whose warnings are all that is on standard
    /// error.
    pub fn json(&self) -> Value {
        assert_eq!(self.code, 0, "{}", self.err);
        let value: Value = serde_json::from_str(&self.out).expect("one JSON value");
        assert!(value.is_object());
        let warnings = value["warnings"].as_array().map_or(&[][..], Vec::as_slice);
        let lines: String = warnings.iter().map(|w| format!("warning: {}\n", w.as_str().expect("a text"))).collect();
        assert_eq!(self.err, lines);
        value
    }

    /// Error line of a run with bad input.
    pub fn error_line(&self) -> &str {
        assert_eq!((self.code, self.out.as_str()), (2, ""), "{}", self.err);
        let line = self.err.strip_suffix('\n').expect("a whole line");
        assert!(!line.contains('\n'), "{line:?} is more than a line");
        line.strip_prefix("teeter: ").expect("the program's name")
    }
}
