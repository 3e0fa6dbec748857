//! Report of `teeter analyse` for people.

use teeter_game::{FallChance, Side};

use super::{Block, Fall, GameReport, Report, Sticks};
use crate::error::Error;
use crate::output;

impl Report {
    /// Prints the blocks as a table, and the moves of a record before it.
    pub fn print(&self, name: &str) -> Result<(), Error> {
        if let Some(game) = &self.game {
            game.print(name)?;
        }
        let of = if self.game.is_some() { "the tower before the last move" } else { "taking each block" };
        output::line(&format!("{name}: {of}; chances with intervals of 95 %, forces in N, - is none below 10 N"))?;
        output::line("block  chance of fall           force  stuck  held by (load in N)")?;
        self.blocks.iter().try_for_each(|block| output::line(&block.line()))
    }
}

impl Block {
    fn line(&self) -> String {
        let force = self.force_n.map_or("-".to_owned(), |force| format!("{force:.3}"));
        // What is below holds every block.
        let holders = self.sticks_by.iter().filter(|contact| contact.side != Side::Below);
        let held_by: Vec<String> = holders.map(Sticks::text).collect();
        let held_by = if held_by.is_empty() { "-".to_owned() } else { held_by.join(", ") };
        let (id, chance, stuck) = (self.id, percents(&self.chance), 100.0 * self.chance_stuck);
        format!("{id:>5}  {chance}  {force:>7}  {stuck:>3.0} %  {held_by}")
    }
}

impl Sticks {
    fn text(&self) -> String {
        let block = self.block.map_or("floor".to_owned(), |id| id.to_string());
        let beside = if self.side == Side::Beside { " beside" } else { "" };
        format!("{block}{beside} ({:.2})", self.load_n)
    }
}

/// Chance of a fall and the ends of its interval, as a text of fixed width.
fn percents(FallChance { chance_of_fall, low, high, .. }: &FallChance) -> String {
    format!("{:>3.0} % ({:>3.0} % to {:>3.0} %)", 100.0 * chance_of_fall, 100.0 * low, 100.0 * high)
}

impl GameReport {
    fn print(&self, name: &str) -> Result<(), Error> {
        output::line(&format!("{name}: {} moves", self.moves.len()))?;
        output::line("turn  player  time s  block  chance of fall           safest")?;
        for (index, played) in self.moves.iter().enumerate() {
            let safest = played.safest_block.zip(played.safest_chance);
            let safest = safest.map_or("-".into(), |(block, chance)| format!("block {block}, {:.0} %", 100.0 * chance));
            let marks = [
                (self.riskiest == Some(index), "riskiest"),
                (played.blunder, "blunder"),
                (played.fell, "the tower fell"),
            ];
            let marks: Vec<&str> = marks.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect();
            let line = format!(
                "{:>4}  {:>6}  {:>6.1}  {:>5}  {}  {safest:<16}  {}",
                played.turn,
                played.player + 1,
                played.at_s,
                played.block,
                percents(&played.chance),
                marks.join(", ")
            );
            output::line(line.trim_end())?;
        }
        output::line(&self.fall.as_ref().map_or("no block fell".to_owned(), Fall::line))
    }
}

impl Fall {
    fn line(&self) -> String {
        let blocks: Vec<String> = self.blocks.iter().map(u32::to_string).collect();
        let blocks = blocks.join(", ");
        let fell = format!("fell at {:.2} s, as block {} was taken: blocks {blocks} first", self.at_s, self.taken);
        let Some(lost) = &self.first_lost else { return fell };
        let below = lost.below.map_or("the floor".to_owned(), |id| format!("block {id}"));
        format!(
            "{fell}\nlost first: block {} on {below}, which bore {:.2} N, at {:.2} s",
            lost.above, lost.load_n, lost.at_s
        )
    }
}
