//! Dry hulls on the device: their rasters behind the grids in the pool, their places in the table.

use arrayvec::ArrayVec;
use floating_body::DryHull;
use glam::{Mat3, Vec2, Vec3};
use open_water_shaders::pipeline::Frame;
use open_water_shaders::surface::{MAX_DRY, SurfaceDry, SurfaceTable};

use crate::Pose;

/// Elements of the pool that rasters take.
pub(super) fn elements(hulls: &[DryHull]) -> u32 {
    hulls.iter().map(|hull| 2 * hull.texels().len() as u32).sum()
}

#[derive(Default)]
pub(crate) struct DryRoom {
    rasters: Vec<DryHull>,
    /// The pool holds them, as of so many lost uploads.
    written: Option<u64>,
    /// Where they begin in it, elements.
    base: u32,
    entries: ArrayVec<SurfaceDry, MAX_DRY>,
    low: Vec2,
    high: Vec2,
}

impl DryRoom {
    /// Takes over the rasters to come.
    pub(crate) fn set(&mut self, rasters: &[DryHull]) {
        self.rasters = rasters.to_vec();
        self.written = None;
    }

    /// The pool is another: it holds nothing.
    pub(crate) fn lose(&mut self) {
        self.written = None;
    }

    /// Writes what the pool lacks.
    pub(crate) fn write(&mut self, frame: &mut Frame<'_>, pool: &wgpu::Buffer) {
        if self.written == Some(frame.losses()) {
            return;
        }
        let mut at = self.base;
        let sent = self.rasters.iter().all(|raster| {
            let offset = u64::from(at) * size_of::<[f32; 2]>() as u64;
            at += elements(std::slice::from_ref(raster));
            frame.write(pool, offset, bytemuck::cast_slice(raster.texels()))
        });
        self.written = sent.then(|| frame.losses());
    }

    /// Says which hulls stand where, each with the number of its raster; rasters begin at element `base`.
    pub(crate) fn place(&mut self, hulls: impl Iterator<Item = (usize, Pose)>, base: u32) {
        self.entries.clear();
        self.base = base;
        (self.low, self.high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        for (raster, pose) in hulls.take(MAX_DRY) {
            let Some(hull) = self.rasters.get(raster) else { continue };
            self.entries.push(entry(hull, pose, base + elements(&self.rasters[..raster])));
            let (low, high) = hull.bounds();
            for corner in 0..8 {
                let side = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
                let p = pose.position + pose.orientation * Vec3::new(side(0), side(1), side(2));
                let p = Vec2::new(p.x, p.z);
                (self.low, self.high) = (self.low.min(p), self.high.max(p));
            }
        }
    }

    pub(crate) fn tell(&self, table: &mut SurfaceTable) {
        if self.entries.is_empty() {
            return;
        }
        table.dry_count = self.entries.len() as u32;
        (table.dry_low, table.dry_high) = (self.low.into(), self.high.into());
        table.dry[..self.entries.len()].copy_from_slice(&self.entries);
    }
}

fn entry(hull: &DryHull, pose: Pose, base: u32) -> SurfaceDry {
    let (corner, cell) = hull.place();
    // Rows of the inverse rotation are the columns of the rotation.
    let axes = Mat3::from_quat(pose.orientation);
    SurfaceDry {
        place: pose.position.into(),
        base,
        x: (axes.x_axis / cell.x).extend(-corner.x / cell.x).into(),
        y: axes.y_axis.extend(0.0).into(),
        z: (axes.z_axis / cell.y).extend(-corner.y / cell.y).into(),
        nodes: hull.nodes(),
        pad: [0; 2],
    }
}
