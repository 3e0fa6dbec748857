//! The twelve moves (section 6.1.2): blocks are taken out slowly and quickly, laid on top, and dropped from one and two centimetres.

use glam::DVec3;
use indicatif::ProgressBar;
use rayon::prelude::*;
use teeter_scene::{BlockPreset, named};

use super::column::{COLUMNS, Column, FRAMES, Grasp, Tower};
use super::page::{mm, table_of_words};
use super::picture;
use crate::fault::Fault;

/// What a move does. Rows and places count from 1, rows from the bottom.
#[derive(Debug, Clone, Copy)]
pub enum Act {
    /// Takes a block out along itself, at a speed, m/s.
    Take(usize, usize, f64),
    /// Lets the block in hand go so high above its place, m.
    Put(usize, usize, f64),
}

const SLOWLY: f64 = 0.03;
const QUICKLY: f64 = 0.3;
/// How high a block is let go that is laid down.
const LAID: f64 = 2e-4;

/// A move, and what the dissertation says of the real tower and of its own.
pub struct Move {
    /// What is done.
    pub act: Act,
    text: &'static str,
    real: &'static str,
    simulated: &'static str,
}

const fn step(act: Act, text: &'static str, real: &'static str, simulated: &'static str) -> Move {
    Move { act, text, real, simulated }
}

use Act::{Put, Take};

/// The moves. Step 2 names no place: 7-3 is a neighbour of the 7-2 of step 4, and over the gap, where it takes load off the 3-1 of step 3.
pub const MOVES: [Move; 12] = [
    step(Take(3, 3, SLOWLY), "take 3-3 slowly", "no movement", "no movement"),
    step(Put(7, 3, LAID), "lay it on top (7-3)", "no movement", "moves a small amount and stops"),
    step(Take(3, 1, SLOWLY), "take 3-1 slowly", "no movement", "the row below moves slightly"),
    step(Put(7, 2, LAID), "lay it in 7-2", "no movement", "no movement"),
    step(Take(4, 3, QUICKLY), "take 4-3 quickly", "moves a little with the block", "moves a little with the block"),
    step(Put(8, 1, 0.01), "drop it from 1 cm on 8-1", "moves slightly on that side", "the same, and takes longer to rest"),
    step(Take(2, 3, QUICKLY), "take 2-3 quickly", "no movement", "sinks slightly towards the gap"),
    step(Put(8, 2, 0.02), "drop it from 2 cm on 8-2", "shakes slightly", "shakes, compresses down to row 3"),
    step(Take(2, 1, SLOWLY), "take 2-1 slowly", "no movement", "a slight effect"),
    step(Put(8, 3, LAID), "lay it in 8-3", "no movement", "none, but the block slides a little"),
    step(Take(5, 1, QUICKLY), "take 5-1 quickly", "no movement", "block 8-1 moves slightly"),
    step(Put(9, 3, 0.01), "drop it from 1 cm on 9-3", "the top row moves a little", "the top row slides a bit and stops"),
];

/// Experiments.
pub const STEPS: u64 = (MOVES.len() * COLUMNS.len()) as u64;

/// What a move did.
#[derive(Debug, Clone, Copy)]
pub struct Outcome {
    /// How far the block of the tower went that went furthest, m.
    pub furthest: f64,
    /// How far they went in the mean, m.
    pub mean: f64,
    /// How far the block in hand ended from where it should, m: of one taken, from the hand; of one put, from its place.
    pub off: f64,
    /// Whether all blocks have stayed in the tower since the first move.
    pub stands: bool,
}

/// Plays the first `count` moves, calling `look` after each.
pub fn play(column: &Column, count: usize, mut look: impl FnMut(&dyn Tower, Outcome)) -> Result<(), Fault> {
    let scene = named("loose").ok_or("there is no scene `loose`")?;
    let mut game =
        Game { tower: (column.build)(&scene)?, places: (0..6).map(|r| [0, 1, 2].map(|c| Some(3 * r + c))).collect(), held: None };
    game.tower.rest(60);
    for Move { act, .. } in &MOVES[..count] {
        let outcome = game.play(*act);
        look(game.tower.as_ref(), outcome);
    }
    Ok(())
}

/// A tower in play.
struct Game {
    tower: Box<dyn Tower>,
    /// Which block is in each place of each row.
    places: Vec<[Option<usize>; 3]>,
    /// The block in hand, and where the hand is.
    held: Option<(usize, DVec3)>,
}

impl Game {
    fn play(&mut self, act: Act) -> Outcome {
        let before = self.tower.centres();
        let (block, off) = match act {
            Take(row, place, speed) => self.take(row - 1, place - 1, speed),
            Put(row, place, above) => self.put(row - 1, place - 1, above),
        };
        let after = self.tower.centres();
        let moves: Vec<f64> = (0..after.len()).filter(|b| *b != block).map(|b| after[b].distance(before[b])).collect();
        let furthest = moves.iter().copied().fold(0.0, f64::max);
        let held = self.held.map(|(b, _)| b);
        // A block that has left its row has come down by half its height.
        let half = 0.5 * BlockPreset::Dissertation.size()[2];
        let in_row = |b: usize, row: usize| after[b].z > (2 * row) as f64 * half;
        let stands = self.places.iter().enumerate().all(|(row, p)| p.iter().flatten().all(|&b| Some(b) == held || in_row(b, row)));
        Outcome { furthest, mean: moves.iter().sum::<f64>() / moves.len() as f64, off, stands }
    }

    /// Takes a block out of its place along itself, and gives it and how far it lags behind the hand at the end.
    fn take(&mut self, row: usize, place: usize, speed: f64) -> (usize, f64) {
        let block = self.places[row][place].take().expect("the moves take what is there");
        let start = self.tower.centre(block);
        let along = if row.is_multiple_of(2) { DVec3::X } else { DVec3::Y };
        let length = BlockPreset::Dissertation.size()[0];
        self.held = Some((block, start));
        self.go(start + (length + 0.01) * along, speed, false);
        self.go(start + (length + 0.05) * along, speed, true);
        self.wait(30);
        let (_, hand) = self.held.unwrap_or((block, start));
        (block, self.tower.centre(block).distance(hand))
    }

    /// Lays or drops the block in hand on its place, and gives it and how far it ends from there sideways.
    fn put(&mut self, row: usize, place: usize, above: f64) -> (usize, f64) {
        let (block, hand) = self.held.expect("the moves put what was taken");
        let top = self.tower.top(&|b| b != block);
        let [_, _, height] = BlockPreset::Dissertation.size();
        let aside = (place as f64 - 1.0) * BlockPreset::Dissertation.pitch();
        let to = if row.is_multiple_of(2) { DVec3::new(0.0, aside, 0.0) } else { DVec3::new(aside, 0.0, 0.0) };
        // On a row that has begun, beside its blocks; on a full one, upon it.
        let begun = self.places.get(row).is_some_and(|r| r.iter().flatten().count() > 0);
        let support = if begun { top - height } else { top };
        let rest = to + (support + 0.5 * height) * DVec3::Z;
        let over = top + 0.05;
        self.go(DVec3::new(hand.x, hand.y, over), 0.25, true);
        self.go(DVec3::new(to.x, to.y, over), 0.25, true);
        self.wait(20);
        self.go(rest + above * DVec3::Z, SLOWLY, true);
        if above > LAID {
            self.wait(20);
        }
        self.held = None;
        if self.places.len() <= row {
            self.places.resize(row + 1, [None; 3]);
        }
        self.places[row][place] = Some(block);
        self.tower.rest(FRAMES as u32);
        (block, (self.tower.centre(block) - rest).truncate().length())
    }

    /// Moves the hand straight to a place.
    fn go(&mut self, to: DVec3, speed: f64, carried: bool) {
        let Some((block, from)) = self.held else { return };
        let frames = (from.distance(to) / speed * FRAMES).ceil().max(1.0) as u32;
        for n in 1..=frames {
            let target = from.lerp(to, f64::from(n) / f64::from(frames));
            self.tower.frame(Some(&Grasp { block: block as u32, target, carried }));
        }
        self.held = Some((block, to));
    }

    /// Holds the hand still.
    fn wait(&mut self, frames: u32) {
        let Some((block, target)) = self.held else { return };
        for _ in 0..frames {
            self.tower.frame(Some(&Grasp { block: block as u32, target, carried: true }));
        }
    }
}

/// Runs them.
pub fn run(bar: &ProgressBar) -> Result<String, Fault> {
    let played: Vec<(Vec<Outcome>, Vec<String>)> = COLUMNS
        .par_iter()
        .map(|column| {
            let (mut outcomes, mut pictures) = (Vec::new(), Vec::new());
            play(column, MOVES.len(), |tower, outcome| {
                let caption = format!("{}, after move {}", column.name, outcomes.len() + 1);
                pictures.push(picture::of(tower, 0.15, false, &caption));
                outcomes.push(outcome);
                bar.inc(1);
            })?;
            Ok((outcomes, pictures))
        })
        .collect::<Result<_, Fault>>()?;
    let cell = |o: &Outcome| {
        let text = format!("{} ({}); block {}", mm(o.furthest), mm(o.mean), mm(o.off));
        if o.stands { text } else { text + "; fallen" }
    };
    let rows: Vec<Vec<String>> = MOVES
        .iter()
        .enumerate()
        .map(|(n, m)| {
            let said = [format!("{}. {}", n + 1, m.text), m.real.to_owned(), m.simulated.to_owned()];
            said.into_iter().chain(played.iter().map(|(outcomes, _)| cell(&outcomes[n]))).collect()
        })
        .collect();
    let head: Vec<&str> =
        ["move", "real tower (dissertation)", "its simulator"].into_iter().chain(COLUMNS.iter().map(|c| c.name)).collect();
    let pictures: String = (0..MOVES.len())
        .map(|n| format!("<h3>{}. {}</h3>{}", n + 1, MOVES[n].text, played.iter().map(|(_, p)| p[n].as_str()).collect::<String>()))
        .collect();
    Ok(format!(
        "<p>Six rows with the loose blocks (L00)-(00L)-(00L)-(0L0)-(L0L)-(LLL), loose by 0.2 mm. Movement of the tower by each move in mm: of the block that \
         went furthest, in brackets the mean; then how far the block in hand ended from the hand or from its place. 2-1 is called loose in step 9, where \
         the map has it bearing load.</p>{}{pictures}",
        table_of_words(&head, &rows)
    ))
}
