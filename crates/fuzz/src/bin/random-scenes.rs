//! Random scenes in number: simulates `COUNT` scenes of a range from the seed `FIRST` on, and
//! prints each that gains energy, sinks, or has a body frozen.
//!
//! `cargo run --release -p teeter-fuzz --bin random-scenes -- wide COUNT [FIRST [SECONDS]]`

use std::process::ExitCode;

use teeter_fuzz::{Extremes, Range, random_scene};
use teeter_scene::Random;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, default: f64| arguments.get(i).map_or(Some(default), |text| text.parse().ok());
    let range = match arguments.first().map(String::as_str) {
        Some("plausible") => Some(Range::Plausible),
        Some("wide") => Some(Range::Wide),
        _ => None,
    };
    let (Some(range), Some(count), Some(first), Some(seconds)) =
        (range, number(1, 100.0), number(2, 0.0), number(3, 2.0))
    else {
        eprintln!("usage: random-scenes plausible|wide COUNT [FIRST [SECONDS]]");
        return ExitCode::from(2);
    };
    let (mut failed, mut worst) = (0, Extremes::default());
    for seed in first as u64..(first + count) as u64 {
        let scene = random_scene(&mut Random::new(seed), range);
        let extremes = Extremes::of(&scene, seconds);
        worst.gain = worst.gain.max(extremes.gain);
        worst.depth = worst.depth.max(extremes.depth);
        worst.syncs = worst.syncs.max(extremes.syncs);
        let violations: Vec<String> = extremes.violations().map(|violation| violation.to_string()).collect();
        if !violations.is_empty() {
            failed += 1;
            println!("seed {seed}: {} ({:?}, radius {:.2e} m)", violations.join(", "), scene.form, scene.edge_radius);
        }
    }
    println!(
        "{failed} of {count} {range:?} scenes of {seconds} s fail; largest gain {:.1e}, depth {:.2}, syncs {:.3} a \
         substep",
        worst.gain, worst.depth, worst.syncs
    );
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
