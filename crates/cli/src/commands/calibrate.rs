//! `teeter calibrate`: chances of a fall held against the outcome of moves that were then played.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use teeter_game::{CalibrationError, HeldOutMove, Proportion, Rules, Table};
use teeter_report::chart::{Axis, Chart, Series};
use teeter_report::progress;
use teeter_scene::{Random, TowerOptions, tower};
use teeter_study::par_map;

use crate::arguments::number;
use crate::error::Error;
use crate::output::{self, Output};

/// Number of bins of the reliability table.
const BINS: usize = 5;
/// Force below which the X-ray calls a block loose, N.
const LOOSE: f64 = 0.1;
/// Rows with which each player has blocks to take.
const MIN_ROWS: i64 = 3;
/// Rows of the tallest tower.
const MAX_ROWS: i64 = 60;

/// Arguments of `teeter calibrate`.
#[derive(Debug, Args)]
pub struct Calibrate {
    /// Number of moves, each on a tower of its own in the middle of a game.
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    moves: u32,
    /// Seed of the first tower; the others follow.
    #[arg(long, default_value_t = 1000)]
    seed: u64,
    /// Rows of the towers.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(MIN_ROWS..=MAX_ROWS))]
    rows: u32,
    /// Simulated time of the rollouts of a move, s: there is one rollout at the least.
    #[arg(long, default_value_t = 15.0, value_parser = number(0.0, 1e6), value_name = "SECONDS")]
    budget: f64,
    /// File for the reliability diagram, SVG.
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Moves whose chance was in one range.
#[derive(Debug, Serialize)]
struct Bin {
    from: f64,
    to: f64,
    moves: u32,
    mean_chance: f64,
    fell: f64,
    low: f64,
    high: f64,
}

/// Mean squares of chance minus outcome.
#[derive(Debug, Serialize)]
struct Brier {
    rollouts: f64,
    /// A block falls where the X-ray calls the block that is taken tight.
    xray: f64,
    /// Shares of the loose and of the tight blocks of these moves that fell.
    xray_fitted: f64,
    /// A block falls where rigid blocks fall; a half where they have no answer.
    statics: f64,
    /// Share of these moves in which a block fell.
    constant: f64,
}

#[derive(Debug, Serialize)]
struct Report {
    moves: u32,
    rows: u32,
    seed: u64,
    budget_s: f64,
    rollouts: u32,
    fell: f64,
    brier: Brier,
    bins: Vec<Bin>,
}

impl Calibrate {
    /// Plays the moves on all cores and prints the table.
    pub fn run(self) -> Result<(), Error> {
        let chart = self.chart.as_deref().map(Output::create).transpose()?;
        let seeds: Vec<u64> = (0..u64::from(self.moves)).map(|k| self.seed.wrapping_add(k)).collect();
        let bar = progress(u64::from(self.moves), "moves");
        let moves = par_map(&seeds, |seed| {
            let held_out = self.play(*seed);
            bar.inc(1);
            held_out
        });
        bar.finish_and_clear();
        let moves = moves.into_iter().collect::<Result<Vec<_>, _>>()?;
        let report = self.report(&moves);
        let mut to_stdout = false;
        if let Some(mut out) = chart {
            out.bytes(report.chart().svg().as_bytes())?;
            to_stdout = out.is_stdout();
            out.finish()?;
        }
        let text = if self.json { output::to_json(&report) } else { report.text() };
        output::report(&text, to_stdout)
    }

    /// A move on the tower of a seed, after up to as many others as it has rows.
    fn play(&self, seed: u64) -> Result<HeldOutMove, Error> {
        let scene = tower(&TowerOptions { rows: self.rows, seed, ..TowerOptions::default() })?;
        let before = Random::new(seed ^ 0x5eed).below(self.rows as usize) as u32;
        let rules = Rules::of(Table::Official, 2);
        HeldOutMove::play(&scene, rules, before, self.budget, seed).map_err(|error| match error {
            CalibrationError::Build(source) => Error::Build { name: scene.name.clone(), source },
            CalibrationError::Rules(source) => source.into(),
        })
    }

    fn report(&self, moves: &[HeldOutMove]) -> Report {
        let mut fell = Proportion::default();
        moves.iter().for_each(|held_out| fell.add(held_out.fell));
        Report {
            moves: self.moves,
            rows: self.rows,
            seed: self.seed,
            budget_s: self.budget,
            rollouts: moves.iter().map(|held_out| held_out.falls.tries).sum(),
            fell: fell.share(),
            brier: Brier::of(moves, fell.share()),
            bins: (0..BINS).filter_map(|bin| Bin::of(moves, bin)).collect(),
        }
    }
}

/// Chance of a fall by rollouts, as `teeter analyse` prints it.
fn chance(held_out: &HeldOutMove) -> f64 {
    held_out.falls.share()
}

fn is_tight(held_out: &HeldOutMove) -> bool {
    held_out.tightness_n >= LOOSE
}

impl Brier {
    fn of(moves: &[HeldOutMove], fell: f64) -> Self {
        let share = |is_wanted: &dyn Fn(&HeldOutMove) -> bool| {
            let mut share = Proportion::default();
            moves.iter().filter(|held_out| is_wanted(held_out)).for_each(|held_out| share.add(held_out.fell));
            share.share()
        };
        let (loose, tight) = (share(&|held_out| !is_tight(held_out)), share(&is_tight));
        let score = |chance: &dyn Fn(&HeldOutMove) -> f64| {
            let error = |held_out: &HeldOutMove| chance(held_out) - f64::from(u8::from(held_out.fell));
            moves.iter().map(|held_out| error(held_out) * error(held_out)).sum::<f64>() / moves.len() as f64
        };
        Self {
            rollouts: score(&chance),
            xray: score(&|held_out| f64::from(u8::from(is_tight(held_out)))),
            xray_fitted: score(&|held_out| if is_tight(held_out) { tight } else { loose }),
            statics: score(&|held_out| held_out.falls_by_statics.map_or(0.5, |falls| f64::from(u8::from(falls)))),
            constant: score(&|_| fell),
        }
    }
}

impl Bin {
    /// The moves of a bin; none where it is empty.
    fn of(moves: &[HeldOutMove], bin: usize) -> Option<Self> {
        let (mut fell, mut sum) = (Proportion::default(), 0.0);
        for held_out in moves.iter().filter(|held_out| ((chance(held_out) * BINS as f64) as usize).min(BINS - 1) == bin)
        {
            fell.add(held_out.fell);
            sum += chance(held_out);
        }
        let [low, high] = fell.interval();
        let edge = |bin: usize| bin as f64 / BINS as f64;
        (fell.tries > 0).then(|| Self {
            from: edge(bin),
            to: edge(bin + 1),
            moves: fell.tries,
            mean_chance: sum / f64::from(fell.tries),
            fell: fell.share(),
            low,
            high,
        })
    }
}

impl Report {
    fn text(&self) -> String {
        let Self { moves, rows, rollouts, .. } = self;
        let first = format!(
            "{moves} moves on towers of {rows} rows, {rollouts} rollouts; a block fell in {:.1} % of them",
            100.0 * self.fell
        );
        let heading = "chance by rollouts  moves  mean  a block fell (interval of 95 %)".to_owned();
        let bins = self.bins.iter().map(|bin| {
            let [from, to, mean, fell, low, high] =
                [bin.from, bin.to, bin.mean_chance, bin.fell, bin.low, bin.high].map(|x| 100.0 * x);
            let moves = bin.moves;
            format!("{from:>8.0} to {to:>3.0} %  {moves:>7}  {mean:>3.0} %  {fell:>3.0} % ({low:.0} % to {high:.0} %)")
        });
        let Brier { rollouts, xray, xray_fitted, statics, constant } = self.brier;
        let scores = format!(
            "Brier score: rollouts {rollouts:.3}, X-ray {xray:.3}, X-ray with the shares of these moves \
             {xray_fitted:.3}, statics {statics:.3}, constant {constant:.3}"
        );
        [first, heading].into_iter().chain(bins).chain([scores]).collect::<Vec<_>>().join("\n")
    }

    fn chart(&self) -> Chart {
        let points = |of: &dyn Fn(&Bin) -> f64| -> Vec<(f64, f64)> {
            self.bins.iter().map(|bin| (bin.mean_chance, of(bin))).collect()
        };
        Chart {
            title: format!("Chance of a fall, {} moves", self.moves),
            x: Axis::new("chance by rollouts"),
            y: Axis::new("share that fell"),
            series: vec![
                Series::line("share that fell", points(&|bin| bin.fell)),
                Series::points(
                    "ends of the interval of 95 %",
                    [points(&|bin| bin.low), points(&|bin| bin.high)].concat(),
                ),
            ],
            diagonal: true,
            ..Chart::default()
        }
    }
}
