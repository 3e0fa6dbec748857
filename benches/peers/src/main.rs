//! Teeter, Rapier and Box3D on the same tower in one process: cost, and accuracy for blocks that
//! 0.1 mm make loose or tight.
#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "a bench measures time; its sums need not be the same everywhere"
)]

mod box3d;
mod entries;
mod error;
mod measure;
mod plot;
mod report;
mod teeter;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use error::PeersError;
use report::Report;
use teeter_peers::{clock, engine, rapier};
use teeter_scene::{TowerOptions, named, tower};
use teeter_study::RigidTower;

const USAGE: &str = "teeter-peers [--seconds N] [--blocks N] [--only TEXT] [--json FILE] [--docs FOLDER] [--from FILE]

  --seconds N     simulated time of the tower at rest, the first 2 s not timed (12)
  --blocks N      how many blocks are pulled, 1 to 54 (54)
  --only TEXT     only the engines and settings whose name contains TEXT
  --json FILE     write all figures there
  --docs FOLDER   write the table into FOLDER/performance.md and the plot to FOLDER/performance.svg
  --from FILE     measure nothing, take the figures of --json";

/// Arguments of the command line.
struct Args {
    seconds: usize,
    blocks: usize,
    only: String,
    json: Option<PathBuf>,
    docs: Option<PathBuf>,
    from: Option<PathBuf>,
}

fn main() -> ExitCode {
    let done = Args::read(std::env::args().skip(1)).and_then(|args| run(&args));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("teeter-peers: {error}");
            ExitCode::from(2)
        }
    }
}

impl Args {
    fn read(mut words: impl Iterator<Item = String>) -> Result<Self, PeersError> {
        let mut args = Self { seconds: 12, blocks: 54, only: String::new(), json: None, docs: None, from: None };
        while let Some(word) = words.next() {
            if word == "--help" {
                return Err(PeersError::Usage(format!("usage: {USAGE}")));
            }
            let mut value = || words.next().ok_or_else(|| PeersError::Usage(format!("{word} needs a value")));
            let number = |text: String, low: usize, high: usize| {
                let number = text.parse().ok().filter(|n| (low..=high).contains(n));
                number.ok_or_else(|| PeersError::Usage(format!("{word} is {text}, expected {low} to {high}")))
            };
            match word.as_str() {
                "--seconds" => args.seconds = number(value()?, 3, 3600)?,
                "--blocks" => args.blocks = number(value()?, 1, 54)?,
                "--only" => args.only = value()?,
                "--json" => args.json = Some(value()?.into()),
                "--docs" => args.docs = Some(value()?.into()),
                "--from" => args.from = Some(value()?.into()),
                _ => return Err(PeersError::Usage(format!("{word} is not known, try --help"))),
            }
        }
        Ok(args)
    }
}

fn run(args: &Args) -> Result<(), PeersError> {
    let report = match &args.from {
        Some(file) => serde_json::from_str(&read(file)?).map_err(|e| PeersError::file(file, e))?,
        None => measure(args)?,
    };
    if let Some(file) = &args.json {
        let json = serde_json::to_string_pretty(&report).map_err(|e| PeersError::file(file, e))?;
        write(file, &(json + "\n"))?;
    }
    println!("{}", report.markdown());
    if let Some(folder) = &args.docs {
        let page = folder.join("performance.md");
        write(&page, &with_table(&read(&page)?, &report.markdown()).ok_or_else(|| PeersError::NoTable(page.clone()))?)?;
        write(&folder.join("performance.svg"), &plot::svg(&report))?;
    }
    Ok(())
}

fn measure(args: &Args) -> Result<Report, PeersError> {
    let mut entries = entries::entries();
    entries.retain(|e| e.name().contains(&args.only));
    if entries.is_empty() {
        return Err(PeersError::UnknownEntry(args.only.clone()));
    }
    let scene = tower(&TowerOptions::default())?;
    let column = named("column").ok_or(PeersError::UnknownScene("column"))?;
    let rigid = RigidTower::new(&scene)?;
    let blocks = sample(args.blocks, scene.blocks.len());
    eprintln!("exact answers");
    let targets: Vec<measure::Target> =
        blocks.iter().map(|&block| measure::Target::new(block, &rigid)).collect::<Result<_, _>>()?;
    let mut results = measure::rest_and_cost(&entries, &scene, args.seconds, rigid.top()?);
    for (entry, result) in entries.iter().zip(&mut results) {
        eprintln!("{}: column and pulls", entry.name());
        result.push_over_coulomb = measure::column_push(entry, &column);
        if result.stands {
            (result.pulls, result.reproducible) = measure::pulls(entry, &scene, &targets);
        }
    }
    Ok(Report { processor: report::processor(), seconds: args.seconds, results })
}

/// Returns `n` of the blocks from bottom to top, left, middle and right in turn. The top row is
/// left out, because neighbours do not affect it.
fn sample(n: usize, blocks: usize) -> Vec<usize> {
    if n + 3 > blocks {
        return (0..n).collect();
    }
    let rows = blocks / 3 - 1;
    let mut all: Vec<usize> =
        (0..n).map(|i| if n <= rows { 3 * (i * rows / n) + i % 3 } else { i * 3 * rows / n }).collect();
    all.dedup();
    all
}

/// Replaces the part of `page` between its marks; `None` without marks.
fn with_table(page: &str, table: &str) -> Option<String> {
    let (begin, end) = ("<!-- table: written by tools/peers -->\n", "<!-- end of table -->");
    let (head, rest) = page.split_once(begin)?;
    let (_, tail) = rest.split_once(end)?;
    Some(format!("{head}{begin}\n{}\n{end}{tail}", table.trim_end()))
}

fn read(file: &Path) -> Result<String, PeersError> {
    std::fs::read_to_string(file).map_err(|e| PeersError::file(file, e))
}

fn write(file: &Path, text: &str) -> Result<(), PeersError> {
    std::fs::write(file, text).map_err(|e| PeersError::file(file, e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sample_has_each_block_once_and_all_columns() {
        for n in 1..=54 {
            let blocks = sample(n, 54);
            assert_eq!(blocks.len(), n);
            assert!(blocks.windows(2).all(|w| w[0] < w[1]) && blocks[n - 1] < 54);
        }
        let columns: Vec<usize> = (0..3).map(|c| sample(15, 54).iter().filter(|&b| b % 3 == c).count()).collect();
        assert_eq!(columns, [5, 5, 5]);
    }

    #[test]
    fn only_the_part_between_the_marks_is_replaced() {
        let page = "a\n<!-- table: written by tools/peers -->\nold\n<!-- end of table -->\nb\n";
        let new = with_table(page, "new\n").unwrap();
        assert_eq!(new, "a\n<!-- table: written by tools/peers -->\n\nnew\n<!-- end of table -->\nb\n");
        assert_eq!(with_table(&new, "new\n").unwrap(), new);
        assert!(with_table("no marks", "new").is_none());
    }
}
