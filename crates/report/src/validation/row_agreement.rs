//! Loose blocks of real towers against those of the engine and of a rule by heights, and the part
//! of the disagreement that the error of a caliper explains.

use serde_json::json;
use teeter_scene::Random;
use teeter_study::{par_map, settled, xray};

use super::real_rows::{Loose, RealRow, RealRows, RowOrder};
use super::section::Section;
use super::size::{Size, params};
use crate::error::Error;
use crate::output::progress;

/// Standard deviations of a caliper's reading, m.
const CALIPER_ERRORS: [f64; 4] = [2e-5, 3e-5, 4e-5, 5e-5];
/// Draws of all heights for the rule.
const RULE_DRAWS: usize = 2000;
/// Draws of all heights for the engine.
const ENGINE_DRAWS: usize = 20;

/// Agreement of two lists of rows, as shares.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Agreement {
    /// Blocks that are loose in both or tight in both.
    blocks: f64,
    /// Rows of which all three blocks agree.
    rows: f64,
}

impl Agreement {
    fn of(a: &[Loose], b: &[Loose]) -> Self {
        let pairs = || a.iter().zip(b);
        let rows = pairs().filter(|(a, b)| a == b).count();
        let blocks: usize = pairs().map(|(a, b)| (0..3).filter(|&i| a[i] == b[i]).count()).sum();
        Self { blocks: blocks as f64 / (3 * a.len()) as f64, rows: rows as f64 / a.len() as f64 }
    }

    fn mean(all: &[Self]) -> Self {
        let mean = |of: fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        Self { blocks: mean(|agreement| agreement.blocks), rows: mean(|agreement| agreement.rows) }
    }

    fn text(self) -> String {
        format!("{:.1} % of blocks, {:.1} % of rows", 100.0 * self.blocks, 100.0 * self.rows)
    }

    /// Shares of an observed disagreement that this one, between two measurements of the same
    /// blocks, is large enough to explain, %.
    fn explains(self, observed: Self) -> String {
        let share = |expected: f64, observed: f64| match 1.0 - observed {
            0.0 => "all".to_owned(),
            disagreement => format!("{:.0} %", (100.0 * (1.0 - expected) / disagreement).min(100.0)),
        };
        format!("{}, {}", share(self.blocks, observed.blocks), share(self.rows, observed.rows))
    }

    fn json(self) -> serde_json::Value {
        json!({"blocks": self.blocks, "rows": self.rows})
    }
}

/// Loose blocks of a row by its heights (m): the middle one where it is lower than the mean of the
/// sides, otherwise both sides.
fn by_height(row: &RealRow, heights: &[f64]) -> Loose {
    let [first, middle, last] = row.blocks.map(|block| heights[block]);
    if 2.0 * middle < first + last { [false, true, false] } else { [true, false, true] }
}

/// Loose blocks of all rows by the rule.
fn rule(real: &RealRows, heights: &[f64]) -> Vec<Loose> {
    real.rows.iter().map(|row| by_height(row, heights)).collect()
}

/// Loose blocks of all rows by the engine: those that bear no load once the tower rests.
fn engine(real: &RealRows, order: RowOrder, heights: &[f64]) -> Result<Vec<Loose>, Error> {
    let mut all = Vec::new();
    for rows in real.towers() {
        let scene = real.scene(rows, order, heights)?;
        let world = settled(&scene, params()).map_err(Error::RealTower)?;
        let loads = xray(&world, scene.friction);
        all.extend((0..rows.len()).map(|row| [0, 1, 2].map(|i| loads[3 * row + i].is_loose())));
    }
    Ok(all)
}

/// Measured heights with an error drawn for each block, m.
fn redrawn(real: &RealRows, error: f64, random: &mut Random) -> Vec<f64> {
    real.heights().iter().map(|height| height + error * random.normal()).collect()
}

/// Compares the loose blocks of real towers with those of the engine and of the rule.
pub fn measure(real: &RealRows, size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "real-rows",
        "Loose blocks of real towers",
        "Towers are built of the measured blocks at 3e6 N/m and simulated until they rest; a block \
         is loose when nothing presses on it. The rule by heights calls the middle block of a row \
         loose where it is lower than the mean of the sides, and otherwise both sides. Caliper: \
         every height is drawn again with a normal error, and each method is compared with itself \
         on the measured heights. A method without a fault would agree with real towers as well as \
         that, so the disagreement with itself is the part that the caliper explains.",
    );
    let truth: Vec<Loose> = real.rows.iter().map(|row| row.loose).collect();
    let heights = real.heights();
    let ruled = rule(real, &heights);
    let share = |rows: &[Loose]| {
        100.0 * rows.as_flattened().iter().filter(|loose| **loose).count() as f64 / (3 * rows.len()) as f64
    };
    let towers = real.towers().count();
    section.inform("rows and towers", format!("{} and {towers}", real.rows.len()));
    let by_rule = Agreement::of(&ruled, &truth);
    let mut simulated = Vec::new();
    for order in RowOrder::ALL {
        let rows = engine(real, order, &heights)?;
        section.inform(format!("engine, rows {}", order.name()), Agreement::of(&rows, &truth).text());
        simulated.push(rows);
    }
    section.inform("rule by heights", by_rule.text());
    section.inform(
        "loose: real towers, engine, rule",
        format!("{:.1}, {:.1}, {:.1} %", share(&truth), share(&simulated[0]), share(&ruled)),
    );
    let by_engine = Agreement::of(&simulated[0], &truth);
    for (name, agreement) in [("engine", by_engine), ("rule", by_rule)] {
        section.number(format!("{name}.blocks"), agreement.blocks);
        section.number(format!("{name}.rows"), agreement.rows);
    }
    let mut table = Vec::new();
    let mut data = Vec::new();
    for error in CALIPER_ERRORS {
        let rule = rule_with_itself(real, error, size.seed);
        let engine = engine_with_itself(real, error, size)?;
        table.push(vec![
            format!("{:.2}", 1e3 * error),
            rule.text(),
            rule.explains(by_rule),
            engine.text(),
            engine.explains(by_engine),
        ]);
        data.push(json!({"error_m": error, "rule": rule.json(), "engine": engine.json()}));
    }
    section.table(
        &["caliper mm", "rule with itself", "explains: blocks, rows", "engine with itself", "explains: blocks, rows"],
        table,
    );
    let engines: Vec<_> = simulated.iter().map(|rows| Agreement::of(rows, &truth).json()).collect();
    section.data = json!({"rule": by_rule.json(), "engine": engines, "caliper": data});
    Ok(section)
}

/// Mean agreement of the rule on the measured heights with that on redrawn ones.
fn rule_with_itself(real: &RealRows, error: f64, seed: u64) -> Agreement {
    let measured = rule(real, &real.heights());
    let mut random = Random::new(seed);
    let draws = (0..RULE_DRAWS).map(|_| Agreement::of(&rule(real, &redrawn(real, error, &mut random)), &measured));
    Agreement::mean(&draws.collect::<Vec<_>>())
}

/// Mean agreement of the engine on the measured heights with that on redrawn ones.
fn engine_with_itself(real: &RealRows, error: f64, size: &Size) -> Result<Agreement, Error> {
    let order = RowOrder::BottomUp;
    let measured = engine(real, order, &real.heights())?;
    let mut random = Random::new(size.seed);
    let count = if size.quick { 2 } else { ENGINE_DRAWS };
    let draws: Vec<Vec<f64>> = (0..count).map(|_| redrawn(real, error, &mut random)).collect();
    let bar = progress(count as u64, "draws of the heights");
    let agreements = par_map(&draws, |heights| {
        let agreement = engine(real, order, heights).map(|rows| Agreement::of(&rows, &measured));
        bar.inc(1);
        agreement
    });
    bar.finish_and_clear();
    Ok(Agreement::mean(&agreements.into_iter().collect::<Result<Vec<_>, _>>()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: Loose = [false; 3];
    const MIDDLE: Loose = [false, true, false];
    const SIDES: Loose = [true, false, true];

    /// Two rows of which the middle block is 0.2 mm too low, and a top row.
    fn real() -> RealRows {
        let block = |id: u32| format!("{id},75,25,{}\n", if id % 3 == 2 && id < 6 { 14.8 } else { 15.0 });
        let blocks = "id,length_mm,width_mm,height_mm\n".to_owned() + &(1..=9).map(block).collect::<String>();
        RealRows::parse(&blocks, "first,middle,last,label\n1,2,3,3\n4,5,6,0\n").unwrap()
    }

    #[test]
    fn engine_and_rule_agree_with_rows_that_heights_decide() {
        let real = real();
        assert_eq!(rule(&real, &real.heights()), [MIDDLE; 2]);
        for order in RowOrder::ALL {
            assert_eq!(engine(&real, order, &real.heights()).unwrap(), [MIDDLE; 2], "{order:?}");
        }
    }

    #[test]
    fn agreement_counts_blocks_and_rows() {
        let agreement = Agreement::of(&[MIDDLE, SIDES], &[MIDDLE, NONE]);
        assert!((agreement.blocks - 4.0 / 6.0).abs() < 1e-12 && agreement.rows == 0.5);
        assert_eq!(agreement.text(), "66.7 % of blocks, 50.0 % of rows");
        // a tenth of the blocks and of the rows differ by the caliper alone
        let caliper = Agreement { blocks: 0.9, rows: 0.9 };
        assert_eq!(caliper.explains(agreement), "30 %, 20 %");
        assert_eq!(agreement.explains(caliper), "100 %, 100 %");
    }

    #[test]
    fn a_caliper_without_error_agrees_with_itself_and_a_bad_one_less_than_a_good_one() {
        let real = real();
        let [exact, good, bad] = [0.0, 5e-5, 5e-4].map(|error| rule_with_itself(&real, error, 1));
        assert_eq!(exact, Agreement { blocks: 1.0, rows: 1.0 });
        // the mean of two deviations against a third: 0.2 mm is 3.3 standard deviations
        assert!(good.rows > 0.995 && bad.rows < 0.8, "{good:?} {bad:?}");
    }
}
