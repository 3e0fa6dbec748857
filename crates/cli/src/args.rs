//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use teeter_physics::{Params, Precision};
use teeter_scene::{
    BlockPreset, Form, MAX_ROWS, Particles, SPRING_STIFFNESS, STIFFNESS, Scene, Springs, WOOD_RESTITUTION, WOOD_SPRINGS,
};

use teeter_report::validation::Topic;

/// A real-time simulator of the tower game Jenga, where contact and friction are springs.
#[derive(Debug, Parser)]
#[command(name = "teeter", version, arg_required_else_help = true, disable_help_subcommand = true)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Serve the page on this machine and open it: play.
    Play(Play),
    /// Print a scene: a tower, a configuration, or one of the list.
    Scene(SceneArgs),
    /// Simulate a scene and say whether it stands.
    Run(Run),
    /// Predict labelled towers: which fall, or at what tilt.
    Score(Score),
    /// Measure the force that starts each block sliding, and say what rigid blocks would need.
    Forces(Forces),
    /// Measure the engine against exact mechanics and what is known of real towers, and write a report.
    Validate(Validate),
    /// The 2003 dissertation: its simulators and results.
    Dissertation(Dissertation),
}

#[derive(Debug, Args)]
pub struct Play {
    /// Port on 127.0.0.1, 0 for any free one [default: 8080, or a free one where that is taken].
    #[arg(long)]
    pub port: Option<u16>,
    /// Leave the browser alone.
    #[arg(long)]
    pub no_open: bool,
}

#[derive(Debug, Args)]
#[command(arg_required_else_help = true, disable_help_subcommand = true)]
pub struct SceneArgs {
    #[command(subcommand)]
    pub what: What,
}

#[derive(Debug, Subcommand)]
#[command(subcommand_help_heading = "What", allow_external_subcommands = true)]
pub enum What {
    /// Print a full tower as JSON.
    Tower(Tower),
    /// Print the tower of a configuration such as (010)-(010)-(011) as JSON.
    Config(Config),
    /// List the scenes that have names; `teeter scene NAME` prints one.
    List(List),
    /// A scene of the list; the words of a [`Named`].
    #[command(external_subcommand)]
    Named(Vec<String>),
}

/// What may follow `teeter scene` in place of a subcommand.
#[derive(Debug, Parser)]
#[command(name = "teeter scene", no_binary_name = true)]
pub struct Named {
    /// Name of a scene of the list.
    pub name: String,
    #[command(flatten)]
    pub material: Material,
}

#[derive(Debug, Args)]
pub struct List {
    /// One JSON object.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Tower {
    /// Rows of three.
    #[arg(long, default_value_t = 18, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_ROWS)))]
    pub rows: u32,
    /// Number of towers, half a metre apart in a square field.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub towers: u32,
    /// Standard deviation of the heights, mm; none is further off than twice that.
    #[arg(long, default_value_t = 0.1, value_parser = number(0.0, 1.0), value_name = "MM")]
    pub height_sd: f64,
    /// Standard deviation of the masses, g [default: 1.85, in proportion for other blocks].
    #[arg(long, value_parser = number(0.0, 4.9), value_name = "G")]
    pub mass_sd: Option<f64>,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Debug, Args)]
pub struct Config {
    /// Rows from the bottom: 1 is a block, 0 is none, L is a loose block (0.2 mm lower).
    #[arg(long, required_unless_present = "loose", conflicts_with = "loose", value_name = "ROWS")]
    pub config: Option<String>,
    /// A full tower of which this names the loose blocks: L is a loose block, 0 an ordinary one.
    #[arg(long, value_name = "ROWS")]
    pub loose: Option<String>,
    /// Standard deviation of the heights, mm.
    #[arg(long, default_value_t = 0.0, value_parser = number(0.0, 1.0), value_name = "MM")]
    pub height_sd: f64,
    /// Standard deviation of the masses, g.
    #[arg(long, default_value_t = 0.0, value_parser = number(0.0, 4.9), value_name = "G")]
    pub mass_sd: f64,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Debug, Args)]
pub struct Common {
    /// Seed of the scatter of heights and masses.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Make of the blocks: dissertation (81 x 26.8 x 18 mm, 19.6 g) or official (75 x 25 x 15 mm, 14.1 g).
    #[arg(long, default_value_t = BlockPreset::Dissertation)]
    pub block: BlockPreset,
    /// Coefficient of static friction.
    #[arg(long, default_value_t = 0.4, value_parser = number(0.0, 2.0))]
    pub friction: f64,
    /// Coefficient of kinetic friction [default: that of static friction].
    #[arg(long, value_parser = number(0.0, 2.0))]
    pub kinetic_friction: Option<f64>,
    /// Coefficient of restitution.
    #[arg(long, default_value_t = WOOD_RESTITUTION, value_parser = number(0.0, 1.0))]
    pub restitution: f64,
    #[command(flatten)]
    pub material: Material,
}

/// What of a scene can be had otherwise.
#[derive(Debug, Args)]
pub struct Material {
    /// Stiffness of a contact of 26.8 mm by 26.8 mm, N/m, 1e4 to 1e8 [default: the scene's own, 1e6 where it names none].
    #[arg(long, value_parser = number(STIFFNESS.0, STIFFNESS.1), value_name = "N/M")]
    pub stiffness: Option<f64>,
    /// What blocks are: rigid, or a lattice of 8 particles and 28 springs each [default: the scene's own, rigid where it names none].
    #[arg(long)]
    pub form: Option<Form>,
    /// Stiffness of each spring of a lattice, N/m, 1e3 to 1e8, or `wood`, 3e7 [default: the scene's own, that of the contacts where it names none].
    #[arg(long, value_parser = spring_stiffness, value_name = "N/M")]
    pub spring_stiffness: Option<f64>,
    /// Where the particles are: inside, so that a block is as hard to turn as a solid one, or corners, as in the dissertation.
    #[arg(long)]
    pub particles: Option<Particles>,
}

impl Material {
    /// The scene with what was asked for in place of its own.
    pub fn applied(&self, scene: Scene) -> Scene {
        let springs = Springs {
            stiffness: self.spring_stiffness.or(scene.springs.stiffness),
            particles: self.particles.unwrap_or(scene.springs.particles),
            ..scene.springs
        };
        Scene {
            stiffness: self.stiffness.unwrap_or(scene.stiffness),
            form: self.form.unwrap_or(scene.form),
            springs,
            ..scene
        }
    }
}

#[derive(Debug, Args)]
pub struct Run {
    /// A scene's file, `-` for standard input, or the name of a scene of the list.
    pub scene: PathBuf,
    /// Time to simulate, s.
    #[arg(long, default_value_t = 10.0, value_parser = number(0.02, 86_400.0))]
    pub seconds: f64,
    #[command(flatten)]
    pub engine: Engine,
    /// Let no block sleep: slower, and shows that nothing rests by being left out.
    #[arg(long)]
    pub no_sleep: bool,
    /// One JSON object.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Score {
    /// Scenes, one JSON object a line, packed by gzip or not; `-` for standard input.
    pub scenes: PathBuf,
    /// Where the predictions go, one JSON object a line [default: standard output].
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub engine: Engine,
    /// The summary as one JSON object on standard output; predictions then only go to --out.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Forces {
    /// A scene's file, `-` for standard input, or the name of a scene of the list.
    pub scene: PathBuf,
    #[command(flatten)]
    pub engine: Engine,
    /// One JSON object.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Validate {
    /// Folder for `validation.html` and `validation.json`; it is made where it is missing.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Only these parts of the report, with commas in between.
    #[arg(long, value_delimiter = ',', value_name = "PARTS", value_parser = topics())]
    pub only: Vec<Topic>,
    /// Low towers and few of them: shows in a minute that everything runs, not more.
    #[arg(long)]
    pub quick: bool,
    /// What blocks are [default: rigid]. A lattice takes six times as long.
    #[arg(long)]
    pub form: Option<Form>,
    /// Towers of each kind [default: 20].
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub towers: Option<u64>,
    /// Seed of the first tower.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Hours of simulated rest, of all towers together [default: 24].
    #[arg(long, value_parser = number(0.001, 1000.0))]
    pub hours: Option<f64>,
    /// Blocks torn out [default: 1000].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub yanks: Option<u32>,
    /// A data sheet of a real tower to compare with, see docs/validation.md; then nothing else is measured unless `--only` asks for it.
    #[arg(long, value_name = "FILE")]
    pub real: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(arg_required_else_help = true, disable_help_subcommand = true)]
pub struct Dissertation {
    #[command(subcommand)]
    pub command: DissertationCommand,
}

#[derive(Debug, Subcommand)]
pub enum DissertationCommand {
    /// Run its chapter of results again and write it as a page.
    Report(ReportArgs),
}

#[derive(Debug, Args)]
pub struct ReportArgs {
    /// Folder for the page, index.html; made where there is none.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Parts to run [default: all]; may be given several times.
    #[arg(long, value_name = "PART", value_parser = teeter_report::dissertation::part_names())]
    pub only: Vec<String>,
}

#[derive(Debug, Args)]
pub struct Engine {
    #[command(flatten)]
    pub material: Material,
    /// Number format of the inner loop.
    #[arg(long, default_value_t = Format::Single)]
    pub precision: Format,
}

/// Number format of the inner loop.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Format {
    /// f32: fast, what is played.
    Single,
    /// f64: the truth.
    Double,
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Format::Single => "single",
            Format::Double => "double",
        })
    }
}

impl Engine {
    /// Constants of a run.
    pub fn params(&self, sleep: bool) -> Params {
        let precision = match self.precision {
            Format::Single => Precision::Single,
            Format::Double => Precision::Double,
        };
        Params { precision, sleep, ..Params::default() }
    }
}

/// Reads a part of the report by its name.
fn topics() -> impl clap::builder::TypedValueParser<Value = Topic> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let values = Topic::ALL.map(|topic| PossibleValue::new(topic.name()).help(topic.summary()));
    PossibleValuesParser::new(values)
        .map(|name| Topic::ALL.into_iter().find(|topic| topic.name() == name).expect("the parser admits only names"))
}

/// Reads a stiffness of springs, or the name of one.
fn spring_stiffness(text: &str) -> Result<f64, String> {
    match text {
        "wood" => Ok(WOOD_SPRINGS),
        _ => number(SPRING_STIFFNESS.0, SPRING_STIFFNESS.1)(text).map_err(|e| format!("{e}, or wood")),
    }
}

/// Reads a number from `low` to `high`; NaN is none.
fn number(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(x) if (low..=high).contains(&x) => Ok(x),
        _ => Err(format!("expected a number from {low} to {high}")),
    }
}
