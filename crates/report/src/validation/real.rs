//! A data sheet of a real tower, measured with a kitchen scale and a spring balance, against the engine. `docs/validation.md` says how to fill it in.

use serde_json::json;
use teeter_scene::{Block, Scene, TowerOptions, tower};
use teeter_study::{force_map, long_axis};

use super::plot::{Axis, Plot, Series};
use super::section::{Section, Size, params};
use super::stats::{correlation, mean, percent};
use crate::error::Error;
use crate::progress;

/// A real tower.
#[derive(Debug)]
pub struct Sheet {
    scene: Scene,
    /// Pulls of each block, N; none where it was not pulled, infinite where it did not move.
    pulls: Vec<Option<f64>>,
    /// What a reading may be off by, N.
    error: f64,
}

/// A block of a sheet: row and column from 1, height (m), mass (kg), pull (N).
type Line = (u32, u32, f64, f64, Option<f64>);

/// A sheet from its text: lines `name,value`, then a line of heads that begins with `row`, then a line a block.
pub fn parse(text: &str) -> Result<Sheet, String> {
    let (mut length, mut width, mut friction, mut error) = (None, None, None, 0.02);
    let mut blocks: Option<Vec<Line>> = None;
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        let at = |message: &str| format!("line {}: {message}", number + 1);
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let value = |i: usize, low: f64, high: f64| -> Result<f64, String> {
            let text = cells.get(i).copied().unwrap_or_default();
            let number = text.parse::<f64>().ok().filter(|v| (low..=high).contains(v));
            number.ok_or(at(&format!("`{text}` is no number from {low} to {high}")))
        };
        match (&mut blocks, cells[0]) {
            (None, "length_mm") => length = Some(1e-3 * value(1, 5.0, 1000.0)?),
            (None, "width_mm") => width = Some(1e-3 * value(1, 5.0, 1000.0)?),
            (None, "friction") => friction = Some(value(1, 0.0, 2.0)?),
            (None, "incline_deg") => friction = Some(libm::tan(value(1, 0.0, 60.0)?.to_radians())),
            (None, "balance_error_N") => error = value(1, 0.0, 5.0)?,
            (None, "row") => blocks = Some(Vec::new()),
            (Some(blocks), _) => {
                let (row, column) = (value(0, 1.0, 200.0)?, value(1, 1.0, 3.0)?);
                let (height, mass) = (1e-3 * value(2, 1.0, 1000.0)?, 1e-3 * value(3, 0.1, 10_000.0)?);
                let pull = match cells.get(4).copied().unwrap_or_default() {
                    "" => None,
                    "-" => Some(f64::INFINITY),
                    _ => Some(value(4, 0.0, 100.0)?),
                };
                blocks.push((row as u32, column as u32, height, mass, pull));
            }
            (None, name) => {
                return Err(at(&format!(
                    "`{name}` is not known, expected length_mm, width_mm, friction, incline_deg, balance_error_N or row"
                )));
            }
        }
    }
    let missing = |what: &str| format!("there is no `{what}`");
    let (length, width) = (length.ok_or(missing("length_mm"))?, width.ok_or(missing("width_mm"))?);
    let friction = friction.ok_or(missing("friction` or `incline_deg"))?;
    let mut blocks = blocks.ok_or(missing("row"))?;
    blocks.sort_by_key(|b| (b.0, b.1));
    if let Some(w) = blocks.windows(2).find(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1)) {
        return Err(format!("row {}, column {} is there twice", w[0].0, w[0].1));
    }
    let rows = blocks.last().map_or(0, |b| b.0);
    if let Some(row) = (1..=rows).find(|row| !blocks.iter().any(|b| b.0 == *row)) {
        return Err(format!("there is no block in row {row}"));
    }
    if rows == 0 {
        return Err("there are no blocks".into());
    }
    // three side by side as wide as a block is long, or touching where they are wider
    let pitch = ((length - width) / 2.0).max(width + 1e-4);
    let mut scene = tower(&TowerOptions { rows: 1, friction, ..TowerOptions::default() }).map_err(|e| e.to_string())?;
    scene.name = "real tower".into();
    scene.stiffness = 3e6;
    scene.blocks.clear();
    let (mut base, mut pulls) = (0.0, Vec::new());
    for row in 1..=rows {
        let of: Vec<_> = blocks.iter().filter(|b| b.0 == row).collect();
        for &&(_, column, height, mass, pull) in &of {
            let side = (f64::from(column) - 2.0) * pitch;
            let z = base + 0.5 * height;
            let (pos, yaw) =
                if row % 2 == 1 { ([0.0, side, z], 0.0) } else { ([side, 0.0, z], std::f64::consts::FRAC_PI_2) };
            scene.blocks.push(Block { id: 10 * row + column, size: [length, width, height], mass, pos, yaw });
            pulls.push(pull);
        }
        base += of.iter().map(|b| b.2).fold(0.0, f64::max);
    }
    scene.validate().map_err(|e| e.to_string())?;
    Ok(Sheet { scene, pulls, error })
}

/// Compares a sheet with the engine.
pub fn section(sheet: &Sheet, _size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "real",
        "A real tower",
        "Heights, masses, friction and pulls from a data sheet. The tower is built from them at 3e6 N/m, and each block is pulled both ways; a reading counts as met where it is within the error of the balance, \
         or 15 % of the force, of one of the two.",
    );
    if sheet.pulls.iter().all(Option::is_none) {
        return Err("the data sheet has no pulls to compare".into());
    }
    let bar = progress(sheet.scene.blocks.len() as u64, "blocks pulled");
    let blocks = force_map(&sheet.scene, params(), || bar.inc(1)).map_err(|e| Error::at(&sheet.scene.name, e))?;
    bar.finish_and_clear();
    let (mut pairs, mut rows, mut met, mut found) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let loose_below = 1.5
        * sheet.scene.friction
        * mean(&sheet.scene.blocks.iter().map(|b| b.mass * sheet.scene.gravity).collect::<Vec<_>>());
    for ((block, pull), of) in blocks.iter().zip(&sheet.pulls).zip(&sheet.scene.blocks) {
        let Some(pull) = *pull else { continue };
        let near = |force: Option<f64>| match force {
            Some(force) => (force - pull).abs() <= sheet.error.max(0.15 * pull.min(force)),
            None => pull.is_infinite(),
        };
        met.push(block.both().into_iter().any(near));
        let least = block.both().into_iter().flatten().fold(f64::INFINITY, f64::min);
        found.push((pull < loose_below, least < loose_below));
        if let Some(f) = block.forward_n.filter(|_| pull.is_finite()) {
            pairs.push((pull, f));
        }
        let newtons = |f: Option<f64>| f.filter(|f| f.is_finite()).map_or("-".into(), |f| format!("{f:.3}"));
        let along = long_axis(of);
        let way = if along.x.abs() > 0.5 { "along x" } else { "along y" };
        rows.push(vec![
            block.id.to_string(),
            way.into(),
            newtons(Some(pull)),
            newtons(block.forward_n),
            newtons(block.backward_n),
            newtons(block.exact.map(|e| e.straight_n)),
        ]);
    }
    section.say("readings met", format!("{:.0} % of {}", percent(&met, |m| *m), met.len()));
    section.say("correlation of the forces", format!("{:.3}", correlation(&pairs)));
    section.say("loose and tight as in the real tower", format!("{:.0} %", percent(&found, |f| f.0 == f.1)));
    section.table(&["block", "lies", "pulled N", "forward N", "backward N", "rigid, straight N"], rows);
    section.data =
        json!({"blocks": blocks, "pulls": sheet.pulls.iter().map(|p| p.filter(|p| p.is_finite())).collect::<Vec<_>>()});
    section.plots.push(Plot {
        title: "Force that starts a block".into(),
        x: Axis::log("real tower, N"),
        y: Axis::log("engine, N"),
        series: vec![Series { name: String::new(), points: pairs, line: false }],
        diagonal: true,
    });
    Ok(section)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "length_mm,75\nwidth_mm,24.9\nincline_deg,20  # mean of ten\nrow,column,height_mm,mass_g,pull_N\n1,2,15.0,14,\n2,1,15.0,14,0.05\n2,3,15.1,14,-\n";

    #[test]
    fn a_sheet_becomes_a_tower() {
        let sheet = parse(GOOD).unwrap();
        assert_eq!(sheet.scene.blocks.len(), 3);
        assert_eq!(sheet.pulls, [None, Some(0.05), Some(f64::INFINITY)]);
        assert!((sheet.scene.friction - 0.36397).abs() < 1e-5);
        assert_eq!(sheet.scene.blocks[2].id, 23);
        assert!((sheet.scene.blocks[2].pos[2] - (0.015 + 0.00755)).abs() < 1e-12);
    }

    #[test]
    fn what_is_wrong_with_a_sheet_is_said() {
        let fault = |from: &str, to: &str| parse(&GOOD.replace(from, to)).unwrap_err();
        assert_eq!(fault("75", "wide"), "line 1: `wide` is no number from 5 to 1000");
        assert_eq!(fault("width_mm,24.9\n", ""), "there is no `width_mm`");
        assert_eq!(fault("2,3,", "2,1,"), "row 2, column 1 is there twice");
        assert_eq!(fault("1,2,15.0", "3,2,15.0"), "there is no block in row 1");
        assert!(fault("width_mm", "wdth_mm").starts_with("line 2: `wdth_mm` is not known"));
    }
}
