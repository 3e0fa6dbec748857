//! `golden`: mints, plays and compares the golden runs. `tools/golden` calls it from the root of the repository.

use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use teeter_golden::{Cell, Fault, Golden, mint, play_all, record, runs, table};
use teeter_physics::Width;

/// Ways to run in one build: a name, the width, the number of threads.
const NATIVE: [(&str, Width, usize); 6] = [
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
        Err(fault) => {
            eprintln!("golden: {fault}");
            ExitCode::from(2)
        }
    }
}

/// Whether all is as it should be.
fn run(dir: &Path, args: &[&str]) -> Result<bool, Fault> {
    match args {
        ["mint", reason] => {
            let changed = mint(dir, reason)?;
            match changed.as_slice() {
                [] => println!("no bit has changed: the golden results stay as they are, with their reason"),
                names => println!("minted; changed: {}", names.join(", ")),
            }
            Ok(true)
        }
        ["record"] => record(dir).map(|()| true),
        ["cells", build] => native(dir, build, &NATIVE),
        ["cells", build, "one"] => native(dir, build, &[("auto", Width::Auto, 2)]),
        ["table"] => {
            let mut text = String::new();
            std::io::stdin().read_to_string(&mut text).map_err(|e| e.to_string())?;
            let cells: Option<Vec<Cell>> = text.lines().map(Cell::parse).collect();
            let golden = Golden::read(dir)?;
            let (matrix, equal) = table(&golden, &cells.ok_or("a line is no cell")?);
            print!("{matrix}");
            println!("{}", if equal { "every cell is equal" } else { "NOT every cell is equal" });
            Ok(equal)
        }
        _ => Err("expected mint \"the reason\", record, cells BUILD [one] or table".into()),
    }
}

/// Prints the cells of this build.
fn native(dir: &Path, build: &str, ways: &[(&str, Width, usize)]) -> Result<bool, Fault> {
    let runs = runs(dir)?;
    for &(name, width, threads) in ways {
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
