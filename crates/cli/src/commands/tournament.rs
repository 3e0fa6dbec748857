//! `teeter tournament`: opponents play against each other, a record a game.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use teeter_game::{Contest, PlayerNames, Proportion, RecordError, Rules, Strength, Table, Thinking, contest};
use teeter_report::{OutFile, progress};
use teeter_scene::{Random, Scene, TowerOptions, tower};
use teeter_study::par_map;

use crate::arguments::number;
use crate::error::Error;
use crate::output;

/// Rows with which each player has blocks to take.
const MIN_ROWS: i64 = 3;
/// Rows of the tallest tower.
const MAX_ROWS: i64 = 60;

/// Arguments of `teeter tournament`.
#[derive(Debug, Args)]
pub struct Tournament {
    /// Number of games. Pairs play in turn, twice on each tower with changed seats.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    games: u32,
    /// Seed of the towers, and of the errors of hand and eye.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for the records, created where it is missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Rows of the towers.
    #[arg(long, default_value_t = 18, value_parser = clap::value_parser!(u32).range(MIN_ROWS..=MAX_ROWS))]
    rows: u32,
    /// Two or more opponents, separated by commas: random, beginner, skilled, expert, gentle.
    #[arg(long, value_delimiter = ',', default_value = "random,beginner,skilled,expert", value_parser = strength)]
    players: Vec<Strength>,
    /// Factor of the simulated time for which an opponent thinks.
    #[arg(long, default_value_t = 1.0, value_parser = number(0.0, 1000.0))]
    effort: f64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// A game to be played.
struct Task {
    number: u32,
    /// Players in the order of their turns.
    seats: [Strength; 2],
    /// Seeds of the tower and of the errors.
    tower: u64,
    errors: u64,
}

#[derive(Debug, Serialize)]
struct Game {
    file: String,
    first: Strength,
    second: Strength,
    winner: Option<Strength>,
    /// Number of the winner's turn order, from 1.
    winner_seat: Option<u32>,
    moves: u32,
    fell: bool,
    seconds: f64,
}

/// Games of one opponent against another, or against all where there is none.
#[derive(Debug, Serialize)]
struct Row {
    player: Strength,
    against: Option<Strength>,
    games: u32,
    wins: u32,
    share: f64,
    low: f64,
    high: f64,
}

#[derive(Debug, Serialize)]
struct Report {
    rows: u32,
    seed: u64,
    effort: f64,
    games: Vec<Game>,
    table: Vec<Row>,
}

impl Tournament {
    /// Plays the games on all cores, writes their records and prints the table.
    pub fn run(self) -> Result<(), Error> {
        let pairs = pairs(&self.players);
        if pairs.is_empty() {
            return Err(Error::OneOpponent);
        }
        let create = |source| Error::Create { name: self.out.display().to_string(), source };
        fs::create_dir_all(&self.out).map_err(create)?;
        let tasks: Vec<Task> = (0..self.games).map(|number| self.task(&pairs, number)).collect();
        let bar = progress(u64::from(self.games), "games");
        let games = par_map(&tasks, |task| {
            let game = self.play(task);
            bar.inc(1);
            game
        });
        bar.finish_and_clear();
        let games = games.into_iter().collect::<Result<Vec<_>, _>>()?;
        let table = table(&self.players, &games);
        let report = Report { rows: self.rows, seed: self.seed, effort: self.effort, games, table };
        if self.json { output::json(&report) } else { report.print() }
    }

    /// The game of a number: pairs in turn, and each pair twice on a tower.
    fn task(&self, pairs: &[[Strength; 2]], number: u32) -> Task {
        let (pair, round) = (number as usize % pairs.len(), number / pairs.len() as u32);
        let [a, b] = pairs[pair];
        let seats = if round.is_multiple_of(2) { [a, b] } else { [b, a] };
        let tower = Random::new(self.seed.wrapping_add(u64::from(round / 2))).bits();
        let errors = Random::new(tower.wrapping_add(u64::from(number) + 1)).bits();
        Task { number, seats, tower, errors }
    }

    fn play(&self, task: &Task) -> Result<Game, Error> {
        let scene = self.tower(task)?;
        let refused = |source: RecordError| Error::Record { name: scene.name.clone(), source };
        let players = task.seats.map(|seat| self.thinking(seat));
        let mut contest = contest(&scene, Rules::of(Table::Official, 2), &players, task.errors).map_err(refused)?;
        contest.record.players = PlayerNames::new(task.seats.map(Strength::name));
        let file = format!("game-{:04}.record", task.number + 1);
        write(&self.out.join(&file), &contest)?;
        let winner = contest.outcome.and_then(|outcome| outcome.winner);
        Ok(Game {
            file,
            first: task.seats[0],
            second: task.seats[1],
            winner: winner.map(|seat| task.seats[seat as usize]),
            winner_seat: winner.map(|seat| seat + 1),
            moves: contest.moves,
            fell: contest.fell,
            seconds: contest.record.seconds(),
        })
    }

    fn tower(&self, task: &Task) -> Result<Scene, Error> {
        // A record stores a tower by its options, and these print the seed as a number.
        Ok(tower(&TowerOptions { rows: self.rows, seed: task.tower >> 32, ..TowerOptions::default() })?)
    }

    fn thinking(&self, strength: Strength) -> Thinking {
        let thinking = strength.thinking();
        Thinking { budget: thinking.budget * self.effort, ..thinking }
    }
}

fn write(path: &Path, contest: &Contest) -> Result<(), Error> {
    let failed = |source| Error::Write { name: path.display().to_string(), source };
    let mut file = OutFile::create(path).map_err(failed)?;
    file.write_all(&contest.record.encode()).and_then(|()| file.finish()).map_err(failed)
}

fn strength(name: &str) -> Result<Strength, String> {
    serde_json::from_value(name.into())
        .map_err(|_| format!("expected one of {}", Strength::ALL.map(Strength::name).join(", ")))
}

/// Pairs of different opponents.
fn pairs(players: &[Strength]) -> Vec<[Strength; 2]> {
    let mut pairs = Vec::new();
    for (index, &a) in players.iter().enumerate() {
        pairs.extend(players[index + 1..].iter().filter(|&&b| b != a).map(|&b| [a, b]));
    }
    pairs
}

/// Results of each opponent against each other and against all. Games without a winner count as not
/// won.
fn table(players: &[Strength], games: &[Game]) -> Vec<Row> {
    let mut table = Vec::new();
    for &player in players {
        let others = players.iter().copied().filter(|&other| other != player).map(Some);
        for against in others.chain([None]) {
            let mut wins = Proportion::default();
            for game in games {
                let other = if game.first == player { game.second } else { game.first };
                let is_in = game.first == player || game.second == player;
                if is_in && against.is_none_or(|against| against == other) {
                    wins.add(game.winner == Some(player));
                }
            }
            let [low, high] = wins.interval();
            let (games, wins, share) = (wins.tries, wins.count, wins.share());
            table.push(Row { player, against, games, wins, share, low, high });
        }
    }
    table
}

impl Report {
    fn print(&self) -> Result<(), Error> {
        let moves: u32 = self.games.iter().map(|game| game.moves).sum();
        let mean = f64::from(moves) / self.games.len() as f64;
        output::line(&format!("{} games on {} rows, {mean:.1} moves each", self.games.len(), self.rows))?;
        output::line("player    against   won   of  share (interval of 95 %)")?;
        for row in self.table.iter().filter(|row| row.games > 0) {
            let against = row.against.map_or("all", Strength::name);
            let Row { player, wins, games, share, low, high, .. } = row;
            let [share, low, high] = [share, low, high].map(|x| 100.0 * x);
            let player = player.name();
            output::line(&format!(
                "{player:<9} {against:<9} {wins:>3} {games:>4}  {share:>3.0} % ({low:.0} % to {high:.0} %)"
            ))?;
        }
        Ok(())
    }
}
