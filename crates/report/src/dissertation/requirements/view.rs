//! Requirement about the view.

use std::f64::consts::FRAC_PI_4;

use glam::DVec3;
use teeter_dissertation::jenga3d::pick::Camera;

use super::oriented_box::OrientedBox;
use super::subject::{Answer, Subject};
use crate::error::Error;

/// Width and height of the pictures, pixels.
const PIXELS: u32 = 64;

/// 1.4: every block of a tower is under the centre of a pixel of one of eight pictures around it.
pub fn all_sides(subject: &Subject) -> Result<Answer, Error> {
    let tower = subject.build_rows(6)?;
    let boxes: Vec<OrientedBox> = (0..tower.len()).map(|block| OrientedBox::of(&tower.corners(block))).collect();
    let mut visible = vec![false; tower.len()];
    for picture in 0..8 {
        let azimuth = f64::from(picture) * FRAC_PI_4 + 0.2;
        let camera =
            Camera { target: DVec3::new(0.0, 0.0, 0.054), distance: 0.6, azimuth, elevation: 0.2, half_height: 0.2 };
        for pixel in 0..PIXELS * PIXELS {
            let position = |n: u32| 2.0 * f64::from(n) / f64::from(PIXELS) - 1.0;
            let ray = camera.ray(position(pixel % PIXELS), position(pixel / PIXELS));
            let entries = boxes.iter().enumerate();
            let entries = entries.filter_map(|(block, b)| Some((b.ray_entry(ray.origin, ray.direction)?, block)));
            if let Some((_, block)) = entries.min_by(|a, b| a.0.total_cmp(&b.0)) {
                visible[block] = true;
            }
        }
    }
    let count = visible.iter().filter(|visible| **visible).count();
    let evidence = format!("{count} of {} blocks seen from eight sides", visible.len());
    Ok(Answer::new(count == visible.len(), evidence))
}
