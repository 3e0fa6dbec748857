//! Player of the moves: takes blocks out of a tower and lays or drops them on top.

use glam::DVec3;
use teeter_dissertation::jenga3d::Constants;
use teeter_scene::{BlockPreset, named};

use crate::dissertation::backend::Grasp;
use crate::dissertation::column::Column;
use crate::dissertation::played::Outcome;
use crate::dissertation::tower::{FRAME_RATE, Tower};
use crate::error::Error;

/// Speed of a slow move, m/s.
pub const SLOWLY: f64 = 0.05;
/// Height at which a block is let go that is laid down, m.
pub const LAID: f64 = 2e-4;
/// Scene of the tower.
const SCENE: &str = "moves";
/// Loose blocks of the scene. 2-1 is among them: step 9 takes it "slowly" and calls it loose, the
/// real tower does not move, and the simulated one is "weighed down on the loose block". The
/// printed map has (00L) for the second row.
pub const LOOSE: &str = "(L00)-(L0L)-(00L)-(0L0)-(L0L)-(LLL)";

/// Speed of a carried block, m/s.
const CARRYING: f64 = 0.25;
/// Clearance of a carried block above the tower, m.
const CLEARANCE: f64 = 0.05;
/// Frames for which the tower settles before the first move, and after a block was let go.
const SETTLING: u32 = FRAME_RATE as u32;
/// Frames for which the hand keeps still after a block came out.
const AFTER_TAKING: u32 = 30;
/// Frames for which the hand keeps still above the tower, and before a drop.
const BEFORE_RELEASE: u32 = 20;

/// Move. Rows and columns count from 1, rows from the bottom.
#[derive(Debug, Clone, Copy)]
pub enum Move {
    /// Takes the block of a row and column out along itself, at a speed (m/s).
    Take(usize, usize, f64),
    /// Lets go of the block in hand above a row and column, at a height (m).
    Put(usize, usize, f64),
}

/// Plays moves and calls `observe` after each. Stops when the tower has fallen.
///
/// # Errors
/// When the tower cannot be built.
pub fn play(
    column: &Column,
    constants: &Constants,
    moves: &[Move],
    mut observe: impl FnMut(&Tower, Outcome),
) -> Result<(), Error> {
    let scene = named(SCENE).ok_or_else(|| Error::UnknownScene(SCENE.to_owned()))?;
    let blocks = (0..6).map(|row| [0, 1, 2].map(|column| Some(3 * row + column))).collect();
    let mut player = Player { tower: (column.build)(&scene, constants)?, blocks, held: None };
    player.tower.rest(SETTLING);
    for &next in moves {
        let outcome = player.play(next);
        observe(&player.tower, outcome);
        if !outcome.stands {
            break;
        }
    }
    Ok(())
}

/// Direction to a player who faces the ends of the blocks of a row and counts its columns from left
/// to right. The corner of the pictures shows both kinds of ends; for rows along x the player is at
/// its right.
fn toward_player(row: usize) -> DVec3 {
    if row.is_multiple_of(2) { DVec3::X } else { -DVec3::Y }
}

/// Horizontal unit vector.
fn level(v: DVec3) -> DVec3 {
    DVec3::new(v.x, v.y, 0.0).normalize_or_zero()
}

struct Player {
    tower: Tower,
    /// Block in each column of each row.
    blocks: Vec<[Option<usize>; 3]>,
    /// Block in hand, and the target of the hand, m.
    held: Option<(usize, DVec3)>,
}

impl Player {
    fn play(&mut self, next: Move) -> Outcome {
        let before = self.tower.centres();
        let (block, error) = match next {
            Move::Take(row, column, speed) => self.take(row - 1, column - 1, speed),
            Move::Put(row, column, height) => self.put(row - 1, column - 1, height),
        };
        let after = self.tower.centres();
        let others = (0..after.len()).filter(|other| *other != block);
        let moved: Vec<f64> = others.map(|other| after[other].distance(before[other])).collect();
        Outcome {
            max_displacement: moved.iter().copied().fold(0.0, f64::max),
            mean_displacement: moved.iter().sum::<f64>() / moved.len() as f64,
            error,
            stands: self.stands(),
        }
    }

    fn stands(&self) -> bool {
        let held = self.held.map(|(block, _)| block);
        let half = 0.5 * BlockPreset::Dissertation.size()[2];
        let in_row = |block: usize, row: usize| self.tower.centre(block).z > (2 * row) as f64 * half;
        let rows = self.blocks.iter().enumerate();
        rows.flat_map(|(row, blocks)| blocks.iter().flatten().map(move |&block| (block, row)))
            .all(|(block, row)| Some(block) == held || in_row(block, row))
    }

    /// Horizontal direction along a block of a row toward the player, and to the player's right,
    /// where the higher columns are.
    fn axes(&self, row: usize, block: usize) -> (DVec3, DVec3) {
        let along = level(self.tower.along(block));
        let along = along * along.dot(toward_player(row)).signum();
        (along, DVec3::Z.cross(along))
    }

    /// Blocks of a row with their columns.
    fn row(&self, row: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        let blocks = self.blocks.get(row).into_iter().flatten().enumerate();
        blocks.filter_map(|(column, block)| block.map(|block| (column, block)))
    }

    /// Takes a block out toward the player and returns it with its distance from the hand at the
    /// end, m. The hand moves along the block as it lies: moved level, it would lift a block of a
    /// leaning tower against the blocks above.
    fn take(&mut self, row: usize, column: usize, speed: f64) -> (usize, f64) {
        let block = self.blocks[row][column].take().expect("the moves take blocks that are there");
        let start = self.tower.centre(block);
        let along = self.tower.along(block);
        let along = along * along.dot(toward_player(row)).signum();
        let length = BlockPreset::Dissertation.size()[0];
        self.held = Some((block, start));
        self.move_hand(start + (length + 0.01) * along, speed, false);
        let end = start + (length + 0.05) * along;
        self.move_hand(end, speed, true);
        self.keep_still(AFTER_TAKING);
        (block, self.tower.centre(block).distance(end))
    }

    /// Lays or drops the block in hand and returns it with its horizontal distance from its
    /// position at the end, m.
    fn put(&mut self, row: usize, column: usize, height: f64) -> (usize, f64) {
        let (block, hand) = self.held.expect("the moves put blocks that were taken");
        let target = self.target(block, row, column);
        let over = self.tower.top(|other| other != block) + CLEARANCE;
        self.move_hand(DVec3::new(hand.x, hand.y, over), CARRYING, true);
        self.move_hand(DVec3::new(target.x, target.y, over), CARRYING, true);
        self.keep_still(BEFORE_RELEASE);
        self.move_hand(target + height * DVec3::Z, SLOWLY, true);
        if height > LAID {
            self.keep_still(BEFORE_RELEASE);
        }
        self.held = None;
        if self.blocks.len() <= row {
            self.blocks.resize(row + 1, [None; 3]);
        }
        self.blocks[row][column] = Some(block);
        self.tower.rest(SETTLING);
        (block, (self.tower.centre(block) - target).truncate().length())
    }

    /// Position of the block in hand at rest in a row and column of the tower as it stands, m: one
    /// pitch from the nearest block of the row, or from the middle of the row below, and on the
    /// highest block of that row.
    fn target(&self, block: usize, row: usize, column: usize) -> DVec3 {
        let nearest = self.row(row).min_by_key(|(other, _)| other.abs_diff(column));
        let middle = match nearest {
            Some((other, neighbour)) => self.beside(block, (row, column), (other, neighbour)),
            None => self.above_row(row, column),
        };
        let highest = self.row(row - 1).map(|(_, below)| self.tower.centre(below).z).fold(0.0, f64::max);
        DVec3::new(middle.x, middle.y, highest + BlockPreset::Dissertation.size()[2])
    }

    /// Position of `block` beside its neighbour in the row. Either may lie askew: the corners keep
    /// the distance that the sides would.
    fn beside(&self, block: usize, (row, column): (usize, usize), (other, neighbour): (usize, usize)) -> DVec3 {
        let right = self.axes(row, neighbour).1;
        let half_width = |block: usize| {
            let centre = self.tower.centre(block);
            self.tower.corners(block).into_iter().map(|corner| (corner - centre).dot(right)).fold(0.0, f64::max)
        };
        let columns = column as f64 - other as f64;
        let askew = (half_width(neighbour) + half_width(block) - BlockPreset::Dissertation.size()[1]).max(0.0);
        self.tower.centre(neighbour) + (columns * BlockPreset::Dissertation.pitch() + columns.signum() * askew) * right
    }

    /// Mean of the positions that the blocks of the row below give for a column of `row`.
    fn above_row(&self, row: usize, column: usize) -> DVec3 {
        let pitch = BlockPreset::Dissertation.pitch();
        let positions: Vec<DVec3> = self
            .row(row - 1)
            .map(|(other, below)| {
                let (along, across) = self.axes(row - 1, below);
                // The right of one row points to the player of the other, or away from the player.
                let along = if row.is_multiple_of(2) { -along } else { along };
                let centre = self.tower.centre(below);
                centre + (1.0 - other as f64) * pitch * across + (column as f64 - 1.0) * pitch * along
            })
            .collect();
        positions.iter().sum::<DVec3>() / positions.len() as f64
    }

    /// Moves the hand straight to a target.
    fn move_hand(&mut self, to: DVec3, speed: f64, carried: bool) {
        let Some((block, from)) = self.held else { return };
        let frames = (from.distance(to) / speed * FRAME_RATE).ceil().max(1.0) as u32;
        for n in 1..=frames {
            let target = from.lerp(to, f64::from(n) / f64::from(frames));
            self.tower.step(Some(&Grasp { block: block as u32, target, carried }));
        }
        self.held = Some((block, to));
    }

    /// Holds the block in hand at its target.
    fn keep_still(&mut self, frames: u32) {
        let Some((block, target)) = self.held else { return };
        for _ in 0..frames {
            self.tower.step(Some(&Grasp { block: block as u32, target, carried: true }));
        }
    }
}
