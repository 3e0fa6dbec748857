//! Colour of a pixel: visible surfaces at several points of it, each shaded once.

use glam::{IVec3, Vec3};

use crate::camera::Lens;
use crate::picture::Size;
use crate::ray::Ray;
use crate::shading::light::Surface;
use crate::shading::wood::Footprint;
use crate::shading::{mix, mix3, table, tone};
use crate::solids::Hit;
use crate::stage::{Materials, Stage};

/// Points of a pixel that are tested first, px from its corner: a rotated grid.
const FIRST: [(f32, f32); 4] = [(0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875)];
/// Points an edge of the grid of a pixel in which the first points see different surfaces.
const GRID: usize = 4;
/// Warmth of the light that wood and table reflect into gaps.
const WOOD_SHADE: Vec3 = Vec3::new(0.30, 0.21, 0.15);
const TABLE_SHADE: Vec3 = Vec3::new(0.16, 0.12, 0.10);
/// Minimum cosine between a ray and the normal of a surface.
const MIN_SLOPE: f32 = 1e-4;

/// Pixels of a picture.
pub struct PixelGrid<'a> {
    pub materials: &'a Materials,
    pub stage: &'a Stage,
    pub lens: Lens,
    pub size: Size,
}

/// Surface that a ray meets first.
#[derive(Debug, Clone, Copy)]
enum Visible {
    /// Block, and the point at which the ray meets it.
    Block(Hit, Vec3),
    /// Table; further points may join its group while it is open.
    Table {
        open: bool,
    },
    Background,
}

/// Points of a pixel that see one surface.
pub struct Group {
    visible: Visible,
    /// Sum of the points, px.
    x: f32,
    y: f32,
    count: u32,
}

impl Visible {
    /// Block and part of its surface; points with the same key share a colour.
    fn key(&self) -> (u32, IVec3) {
        match self {
            Self::Block(hit, _) => (hit.block, hit.part),
            Self::Table { open } => (u32::MAX, IVec3::splat(i32::from(*open))),
            Self::Background => (u32::MAX - 1, IVec3::ZERO),
        }
    }
}

impl PixelGrid<'_> {
    /// Returns red, green and blue of a pixel. `groups` is memory for its work.
    pub fn colour(&self, groups: &mut Vec<Group>, x: u32, y: u32) -> [u8; 3] {
        let corner = (x as f32, y as f32);
        groups.clear();
        FIRST.iter().for_each(|&point| self.add(groups, corner, point));
        if groups.len() > 1 || self.is_foot(&groups[0]) {
            groups.clear();
            for k in 0..GRID * GRID {
                // Each row is offset, so that a steep edge crosses points one after the other.
                let (row, column) = (k / GRID, k % GRID);
                let offset = (row as f32 + 0.5) / GRID as f32;
                let point = ((column as f32 + offset) / GRID as f32, (row as f32 + 0.5) / GRID as f32);
                self.add(groups, corner, point);
                split_table(groups);
            }
        }
        let points: u32 = groups.iter().map(|group| group.count).sum();
        let sum: Vec3 = groups.iter().map(|group| group.count as f32 * self.shade(group)).sum();
        let colour = 255.0 * sum / points as f32;
        colour.to_array().map(|channel| (channel + 0.5) as u8)
    }

    /// Returns true for a point of the table at the foot of a block, where it is dark and light
    /// within one pixel.
    fn is_foot(&self, group: &Group) -> bool {
        let (x, y) = (group.x / group.count as f32, group.y / group.count as f32);
        let point = || intersect(&self.lens.ray(x, y), Vec3::ZERO, Vec3::Z);
        matches!(group.visible, Visible::Table { .. }) && self.stage.occlusion.is_foot(point())
    }

    fn add(&self, groups: &mut Vec<Group>, corner: (f32, f32), point: (f32, f32)) {
        let (x, y) = (corner.0 + point.0, corner.1 + point.1);
        let visible = self.visible(&self.lens.ray(x, y));
        match groups.iter_mut().find(|group| group.visible.key() == visible.key()) {
            Some(group) => {
                group.x += x;
                group.y += y;
                group.count += 1;
            }
            None => groups.push(Group { visible, x, y, count: 1 }),
        }
    }

    fn visible(&self, ray: &Ray) -> Visible {
        let floor = -ray.origin.z / ray.direction.z;
        match self.stage.solids.first_hit(ray) {
            Some(hit) if floor < 0.0 || hit.distance < floor => Visible::Block(hit, ray.at(hit.distance)),
            _ if floor > 0.0 => Visible::Table { open: true },
            _ => Visible::Background,
        }
    }

    /// Colour of the surface of a group at the mean of its points, as sRGB from 0 to 1.
    fn shade(&self, group: &Group) -> Vec3 {
        let (x, y) = (group.x / group.count as f32, group.y / group.count as f32);
        let background = || table::background(x / self.size.width as f32, y / self.size.height as f32);
        match &group.visible {
            Visible::Block(hit, anchor) => self.wood(hit, *anchor, (x, y)),
            Visible::Table { .. } => {
                let ray = self.lens.ray(x, y);
                let point = intersect(&ray, Vec3::ZERO, Vec3::Z);
                let opacity = self.materials.table.opacity(point);
                if opacity > 0.0 { mix3(background(), self.table(point, &ray), opacity) } else { background() }
            }
            Visible::Background => background(),
        }
    }

    fn wood(&self, hit: &Hit, anchor: Vec3, (x, y): (f32, f32)) -> Vec3 {
        let solid = &self.stage.solids.list()[hit.block as usize];
        let ray = self.lens.ray(x, y);
        let on_surface = |x: f32, y: f32| intersect(&self.lens.ray(x, y), anchor, hit.normal);
        let point = on_surface(x, y);
        let footprint = Footprint {
            point: solid.local_point(point),
            right: solid.local_direction(on_surface(x + 1.0, y) - point),
            down: solid.local_direction(on_surface(x, y + 1.0) - point),
        };
        let wood = self.materials.logs[hit.block as usize].at(&footprint, hit.local_normal);
        let surface =
            Surface { normal: hit.normal, view: -ray.direction, colour: wood.colour, roughness: wood.roughness };
        let sky = self.stage.occlusion.sky(point, hit.normal);
        let light = self.materials.lights.reflect(&surface, self.sun(point, hit.normal));
        let shade = mix3(WOOD_SHADE, Vec3::ONE, sky) * mix(0.35, 1.0, sky);
        screen(light.indirect * shade + light.direct * mix(0.55, 1.0, sky) + light.specular * sky)
    }

    fn table(&self, point: Vec3, ray: &Ray) -> Vec3 {
        let surface = Surface {
            normal: Vec3::Z,
            view: -ray.direction,
            colour: self.materials.table.colour(),
            roughness: table::ROUGHNESS,
        };
        let sky = self.stage.occlusion.sky(point, Vec3::Z);
        let light = self.materials.lights.reflect(&surface, self.sun(point, Vec3::Z));
        let shade = mix3(TABLE_SHADE, Vec3::ONE, sky);
        screen(light.indirect * shade + light.direct * mix(0.4, 1.0, sky) + light.specular)
    }

    /// Fraction of the sun's light at a point of a surface.
    fn sun(&self, point: Vec3, normal: Vec3) -> f32 {
        let Materials { sun, lights, .. } = self.materials;
        // A side that is turned away gets no light that a shadow could take.
        if normal.dot(lights.sun_direction) <= 0.0 { 1.0 } else { sun.light(&self.stage.solids, point, normal) }
    }
}

/// Closes the last group where it is of the table, so that each of its points has its own colour.
fn split_table(groups: &mut [Group]) {
    if let Some(group) = groups.iter_mut().find(|group| matches!(group.visible, Visible::Table { open: true })) {
        group.visible = Visible::Table { open: false };
    }
}

/// Returns linear light as the screen shows it, sRGB from 0 to 1.
fn screen(light: Vec3) -> Vec3 {
    tone::encode(tone::neutral(light))
}

/// Returns the point of a plane that a ray meets. A ray along the plane, as at the edge of a block,
/// meets it far away.
fn intersect(ray: &Ray, anchor: Vec3, normal: Vec3) -> Vec3 {
    let slope = ray.direction.dot(normal).min(-MIN_SLOPE);
    ray.at((anchor - ray.origin).dot(normal) / slope)
}
