//! `golden`: mints, plays and compares the golden runs. `tools/golden` calls it in the root of the
//! repository.

use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use teeter_golden::{Cell, Golden, GoldenError, mint, play_all, record, runs, table};
use teeter_physics::Width;

/// Mode of a native build: name, register width, number of threads.
type Mode = (&'static str, Width, usize);

/// Modes of a native build.
const NATIVE: [Mode; 6] = [
    ("portable", Width::Portable, 1),
    ("sse2", Width::Sse2, 1),
    ("avx2", Width::Avx2, 1),
    ("avx512", Width::Avx512, 1),
    ("2 threads", Width::Auto, 2),
    ("5 threads", Width::Auto, 5),
];

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(Path::new("data/golden"), &args.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(equal) => ExitCode::from(u8::from(!equal)),
        Err(error) => {
            eprintln!("golden: {error}");
            ExitCode::from(2)
        }
    }
}

/// Error of the command line.
#[derive(Debug, thiserror::Error)]
enum Error {
    #[error(transparent)]
    Golden(#[from] GoldenError),
    #[error("standard input: {0}")]
    Stdin(#[from] std::io::Error),
    #[error("a line is no cell")]
    Cell,
    #[error("expected mint \"the reason\", record, cells BUILD [one] or table")]
    Usage,
}

/// Runs a command, and returns false if a cell differs from the golden results.
fn run(dir: &Path, args: &[&str]) -> Result<bool, Error> {
    match args {
        ["mint", reason] => {
            let changed = mint(dir, reason)?;
            match changed.as_slice() {
                [] => println!("no bit has changed: the golden results stay as they are, with their reason"),
                names => {
                    println!("minted; changed: {}", names.join(", "));
                    println!("write {} to crates/game/src/record/engine.rs", Golden::read(dir)?.bits());
                }
            }
            Ok(true)
        }
        ["record"] => {
            record(dir)?;
            Ok(true)
        }
        ["cells", build] => native(dir, build, &NATIVE),
        ["cells", build, "one"] => native(dir, build, &[("auto", Width::Auto, 2)]),
        ["table"] => {
            let mut text = String::new();
            std::io::stdin().read_to_string(&mut text)?;
            let cells: Option<Vec<Cell>> = text.lines().map(Cell::parse).collect();
            let golden = Golden::read(dir)?;
            let (matrix, equal) = table(&golden, &cells.ok_or(Error::Cell)?);
            print!("{matrix}");
            println!("{}", if equal { "every cell is equal" } else { "NOT every cell is equal" });
            Ok(equal)
        }
        _ => Err(Error::Usage),
    }
}

/// Prints the cells of this build.
fn native(dir: &Path, build: &str, modes: &[Mode]) -> Result<bool, Error> {
    let runs = runs(dir)?;
    for &(name, width, threads) in modes {
        if !width.available() {
            eprintln!("golden: this processor has no {name}: its cells are left out");
            continue;
        }
        for (run, outcome) in runs.iter().zip(play_all(&runs, width, threads)?) {
            println!("{}", Cell { column: format!("{build}, {name}"), run: run.name.clone(), outcome }.line());
        }
    }
    Ok(true)
}
