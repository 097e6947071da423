//! The textures of a body: how each of its modes moves the water around it, and how that moves the body.

use glam::Vec2;

use super::curve::{Curve, Mode};
use super::fit::{Basis, Target};
use super::kernel::Element;
use super::table::RadiationTables;
use crate::coefficients::Coefficients;
use crate::hull::Waterline;
use crate::{BodyError, ForcePoint};

/// A part of a texture: `weight * d / (2 pi (r^2 + d^2)^1.5) * (1 - (r/reach)^2)^2` around its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureKernel {
    /// Place from the centre of mass, hull axes (x, z), m.
    pub offset: Vec2,
    /// Depth d in m.
    pub depth: f32,
    /// Its integral but for what the taper takes: m^2 in heave, m^3 in roll and pitch, m^3 of the hull.
    pub weight: f32,
}

/// What a body writes into a dispersive grid, and reads there with the same weights. Moved by `dz` in a mode, the water
/// falls by `dz` times the sum of its kernels; waves of height `h` push with `rho g` times the integral of their
/// product with `h`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Textures {
    /// Up and down.
    pub heave: Vec<TextureKernel>,
    /// About the hull's x axis; empty where the coefficients stand for the mode.
    pub roll: Vec<TextureKernel>,
    /// About its z axis; the same.
    pub pitch: Vec<TextureKernel>,
    /// The volume at rest, every piece from its depth: what a hull under way carries along.
    pub hull: Vec<TextureKernel>,
    /// Distance in m at which every kernel ends.
    pub reach: f32,
    /// Added mass in heave (kg), added inertia in roll and pitch (kg m^2) that stay with the body.
    pub left: [f32; 3],
}

/// What the fit needs to know of a body.
pub(crate) struct Afloat<'a> {
    pub(crate) waterline: &'a Waterline,
    /// Relative to the centre of mass.
    pub(crate) points: &'a [ForcePoint],
    /// Centre of the waterplane from the centre of mass (x, z), and height of the water over it, m.
    pub(crate) center: Vec2,
    pub(crate) level: f32,
    /// Metacentric heights (roll, pitch) in m.
    pub(crate) heights: Vec2,
    pub(crate) mass: f32,
    /// Rigid inertia in roll and pitch, kg m^2.
    pub(crate) inertia: Vec2,
    pub(crate) density: f32,
    pub(crate) coefficients: &'a Coefficients,
    pub(crate) tables: &'a RadiationTables,
    pub(crate) sphere: bool,
}

/// Depths of the kernels, in radii of the disc with the waterplane's area.
const DEPTHS: [f64; 4] = [0.2, 0.4, 0.8, 1.6];
/// Reach in the same radii: with 4 a hemisphere's decay errs by 2.4 % of its release instead of 1.7.
const REACH: f64 = 5.0;
/// Kernels shallower than this many cells would be grid noise.
const SHALLOWEST: f64 = 1.0;
/// Those of the hull, which moves over the cells.
const HULL: f32 = 1.0;
/// And those shallower than this share of their column's half width, so that a hull makes one wave and not one a column.
const SMOOTH: f32 = 1.2;
/// Places along the hull by its slenderness, at most.
const MOST: f64 = 8.0;
/// Share of the waterplane's second moments that the places have: kernels widen them, and a hull's ends radiate less.
const DRAWN_IN: f64 = 0.5;
/// Least mass left, as a share of the whole: a texture that would carry more is no good.
const LEAST: f64 = 0.1;

impl Textures {
    /// Refuses tables that leave out the body's own frequencies.
    pub(crate) fn check(a: &Afloat) -> Result<(), BodyError> {
        if a.waterline.area > 0.0 { Mode::of(a).map(drop) } else { Ok(()) }
    }

    /// For a grid with cells of `cell` m. `None` for what has no waterplane.
    pub(crate) fn fit(a: &Afloat, cell: f32) -> Result<Option<Self>, BodyError> {
        let w = a.waterline;
        if !(w.area > 0.0 && w.volume > 0.0) {
            return Ok(None);
        }
        let modes = Mode::of(a)?;
        let radius = (f64::from(w.area) / std::f64::consts::PI).sqrt();
        let shallowest = SHALLOWEST * f64::from(cell);
        let mut depths: Vec<f64> = DEPTHS.iter().map(|d| d * radius).filter(|d| *d >= shallowest).collect();
        let mut deeper = 1.0;
        while depths.len() < 3 {
            depths.push(shallowest * deeper);
            deeper *= 2.0;
        }
        depths.sort_unstable_by(f64::total_cmp);
        let reach = REACH * radius.max(shallowest);
        let own = modes.iter().flatten().map(|mode| mode.natural * mode.natural / f64::from(crate::GRAVITY));
        let (low, high) = own.fold((f64::INFINITY, 0.0_f64), |(low, high), k| (low.min(k), high.max(k)));
        if !(low > 0.0 && high.is_finite()) {
            return Ok(None);
        }
        let basis = Basis::new(depths, reach, (low, high));
        let mut textures = Self { hull: hull(a, cell), reach: reach as f32, ..Self::default() };
        for (i, mode) in modes.iter().enumerate() {
            let Some(mode) = mode else { continue };
            let elements = line(a, i);
            let Some(curve) = Curve::new(a, mode, &elements, i) else { continue };
            let target = Target {
                elements: &elements,
                natural: mode.natural,
                added: mode.added,
                excitation: &|omega| curve.excitation(omega),
            };
            let Some(fitted) = basis.fit(&target, f64::from(a.density)) else { continue };
            textures.left[i] = fitted.left.max(LEAST * mode.added) as f32;
            let kernels = elements.iter().flat_map(|element| {
                let [x, z] = element.at.map(|v| v as f32);
                basis.depths().iter().zip(&fitted.weights).map(move |(depth, weight)| TextureKernel {
                    offset: a.center + Vec2::new(x, z),
                    depth: *depth as f32,
                    weight: (weight * element.weight) as f32,
                })
            });
            *[&mut textures.heave, &mut textures.roll, &mut textures.pitch][i] = kernels.collect();
        }
        Ok(if textures.heave.is_empty() { None } else { Some(textures) })
    }
}

/// Places on the hull's x axis with this second moment over the area, evenly. Not fewer than two.
fn places(moment: f64, count: usize) -> impl Iterator<Item = f64> {
    let n = count as f64;
    let end = (3.0 * moment.max(0.0) * n * n / (n * n - 1.0)).sqrt();
    (0..count).map(move |i| end * ((2 * i + 1) as f64 / n - 1.0))
}

/// Second moments over the area of the waterplane along and across it, m^2, and how many places there are along it.
fn moments(a: &Afloat) -> ([f64; 2], usize) {
    let w = a.waterline;
    let [along, across] = [w.moments.x, w.moments.y].map(|m| f64::from(m / w.area).max(0.0));
    let slender = if across > 0.0 { (along / across).sqrt() } else { MOST };
    ([along, across], (2.0 * slender).round().clamp(2.0, MOST) as usize)
}

/// Where a mode's texture acts (0 heave, 1 roll, 2 pitch), about the waterplane's centre: along a line for heave and
/// pitch, on two for roll.
pub(super) fn line(a: &Afloat, mode: usize) -> Vec<Element> {
    let ([along, across], count) = moments(a);
    let area = f64::from(a.waterline.area);
    let along = || places(DRAWN_IN * along, count);
    let share = area / count as f64;
    match mode {
        0 if count == 2 => vec![Element { at: [0.0; 2], weight: area }],
        0 => along().map(|x| Element { at: [x, 0.0], weight: share }).collect(),
        // Heave at a place is y + pitch x - roll z.
        1 => {
            let half = (DRAWN_IN * across).sqrt();
            along().flat_map(|x| [-half, half].map(|z| Element { at: [x, z], weight: -0.5 * z * share })).collect()
        }
        _ => along().map(|x| Element { at: [x, 0.0], weight: x * share }).collect(),
    }
}

/// The volume at rest, three pieces a column.
fn hull(a: &Afloat, cell: f32) -> Vec<TextureKernel> {
    const LAYERS: u16 = 3;
    let mut kernels = Vec::new();
    for point in a.points {
        let under = a.level - point.position.y;
        let share = point.immersion(under, glam::Vec3::Y).share;
        let (top, bottom) = ((under - point.half.y).max(0.0), under + point.half.y);
        if share <= 0.0 || bottom <= 0.0 {
            continue;
        }
        for layer in 0..LAYERS {
            let depth = top + (bottom - top) * (f32::from(layer) + 0.5) / f32::from(LAYERS);
            kernels.push(TextureKernel {
                offset: Vec2::new(point.position.x, point.position.z),
                depth: depth.max(HULL * cell).max(SMOOTH * point.half.x.max(point.half.z)),
                weight: point.volume * share / f32::from(LAYERS),
            });
        }
    }
    kernels
}
