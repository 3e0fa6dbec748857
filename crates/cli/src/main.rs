//! The program `teeter`.

use std::process::ExitCode;

fn main() -> ExitCode {
    teeter_cli::run(std::env::args_os()).into()
}
