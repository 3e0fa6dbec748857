//! `counts`: counts the instructions of the workloads and compares them with the accepted ones.
//! `tools/counts` calls it in the root of the repository.

mod callgrind;

use std::path::Path;
use std::process::ExitCode;

use rayon::prelude::*;
use teeter_cost::{Baseline, COMPILER, CostError, Count, Workload, compare, counted};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(Path::new("data/baselines/instructions.json"), &args.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(passed) => ExitCode::from(u8::from(!passed)),
        Err(error) => {
            eprintln!("counts: {error}");
            ExitCode::from(2)
        }
    }
}

/// Runs a command, and returns false if a check fails.
fn run(file: &Path, args: &[&str]) -> Result<bool, CostError> {
    match args {
        ["check"] => check(file),
        ["show", name] => show(file, name).map(|()| true),
        ["accept", reason] => accept(file, reason).map(|()| true),
        ["play", name, state] => {
            let workload = counted()?.into_iter().find(|w| w.name == *name).ok_or(CostError::UnknownWorkload)?;
            let (substeps, hash) = callgrind::play(&workload, Path::new(state))?;
            println!("{substeps} {hash}");
            Ok(true)
        }
        _ => Err(CostError::Usage("expected check, show NAME or accept \"the reason\"".into())),
    }
}

fn check(file: &Path) -> Result<bool, CostError> {
    let baseline = Baseline::read(file)?;
    let (workloads, unavailable) = playable()?;
    let comparison = compare(Some(&baseline), &count_all(&workloads)?, COMPILER, &unavailable);
    print!("{}", comparison.table);
    comparison.notes.iter().for_each(|note| println!("{note}"));
    comparison.failures.iter().for_each(|failure| println!("FAILED {failure}"));
    match comparison.failures.as_slice() {
        [] => println!("nothing costs more than it may"),
        _ => println!("If this is meant: tools/counts accept \"what made it so\""),
    }
    Ok(comparison.failures.is_empty())
}

/// Counts the workloads whose names contain `name`, and prints them beside the accepted counts.
fn show(file: &Path, name: &str) -> Result<(), CostError> {
    let baseline = Baseline::read(file)?;
    let (workloads, _) = playable()?;
    let workloads: Vec<_> = workloads.into_iter().filter(|workload| workload.name.contains(name)).collect();
    print!("{}", compare(Some(&baseline), &count_all(&workloads)?, COMPILER, &[]).table);
    Ok(())
}

/// Replaces the accepted counts.
fn accept(file: &Path, reason: &str) -> Result<(), CostError> {
    let reason = teeter_golden::reason("the counts", reason)?.to_owned();
    let (workloads, unavailable) = playable()?;
    if !unavailable.is_empty() {
        return Err(CostError::Unavailable(unavailable.join("; ")));
    }
    let counts = count_all(&workloads)?;
    let before = Baseline::read(file).ok();
    print!("{}", compare(before.as_ref(), &counts, COMPILER, &[]).table);
    if before.is_some_and(|before| before.counts == counts && before.compiler == COMPILER) {
        println!("no count has changed: the baseline stays as it is, with its reason");
        return Ok(());
    }
    Baseline { reason, compiler: COMPILER.into(), counts }.write(file)?;
    println!("accepted, in {}", file.display());
    Ok(())
}

/// Returns the workloads that this processor can play, and the names of the others. With narrower
/// registers the count would be that of another program.
fn playable() -> Result<(Vec<Workload>, Vec<String>), CostError> {
    let (playable, others): (Vec<_>, Vec<_>) =
        counted()?.into_iter().partition(|workload| workload.params.width.available());
    Ok((playable, others.into_iter().map(|workload| workload.name).collect()))
}

/// Counts workloads in parallel on all cores; counts do not depend on the load of the machine.
fn count_all(workloads: &[Workload]) -> Result<Vec<Count>, CostError> {
    workloads.par_iter().map(callgrind::count).collect()
}
