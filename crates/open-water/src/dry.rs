//! Hulls in which no water is to be seen: which they are, which of them are drawn, and whether a point is in one.

use arrayvec::ArrayVec;
use floating_body::DryHull;
use glam::Vec3;
use open_water_shaders::surface::MAX_DRY;

use crate::desc::View;
use crate::plan::FramePlan;
use crate::store::BodyId;
use crate::water::OpenWater;
use crate::{OpenWaterError, Pose};

/// Dry hulls in the composite surface's table: as of which moment, after how many changes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct DryMark {
    moment: Option<(u64, f32)>,
    changes: u64,
}

/// What a plan says of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct DryPlan {
    /// Those that are drawn, nearest first.
    pub(crate) bodies: ArrayVec<BodyId, MAX_DRY>,
    /// How many there are.
    pub(crate) of: usize,
    changes: u64,
}

/// A dry hull and which of the rasters is its own.
#[derive(Clone)]
pub(crate) struct Dry {
    pub(crate) body: BodyId,
    pub(crate) hull: DryHull,
    pub(crate) raster: usize,
}

#[derive(Clone, Default)]
pub(crate) struct DryHulls {
    list: Vec<Dry>,
    /// Their rasters, each once.
    rasters: Vec<DryHull>,
    changes: u64,
}

impl DryHulls {
    fn set(&mut self, body: BodyId, hull: Option<DryHull>) {
        self.list.retain(|dry| dry.body != body);
        self.list.extend(hull.map(|hull| Dry { body, hull, raster: 0 }));
        self.rasters.clear();
        for dry in &mut self.list {
            let same = |known: &DryHull| std::ptr::eq(known.texels(), dry.hull.texels());
            dry.raster = self.rasters.iter().position(same).unwrap_or(self.rasters.len());
            if dry.raster == self.rasters.len() {
                self.rasters.push(dry.hull.clone());
            }
        }
        self.changes += 1;
    }

    pub(crate) fn forget(&mut self, body: BodyId) {
        if self.list.iter().any(|dry| dry.body == body) {
            self.set(body, None);
        }
    }

    /// Lets go of all others.
    pub(crate) fn keep(&mut self, keep: impl Fn(BodyId) -> bool) {
        for body in self.list.iter().map(|dry| dry.body).filter(|body| !keep(*body)).collect::<Vec<_>>() {
            self.set(body, None);
        }
    }

    #[cfg(feature = "gpu")]
    pub(crate) fn get(&self, body: BodyId) -> Option<&Dry> {
        self.list.iter().find(|dry| dry.body == body)
    }

    #[cfg(feature = "gpu")]
    pub(crate) fn rasters(&self) -> &[DryHull] {
        &self.rasters
    }

    /// The bodies whose hulls are nearest to any of the views, the first ones without a view; and how many are too far to be
    /// seen.
    pub(crate) fn plan(
        &self,
        views: &[View],
        place: impl Fn(BodyId) -> Option<Vec3>,
        seen: impl Fn(&Dry, Vec3) -> bool,
    ) -> (DryPlan, usize) {
        let mut near = ArrayVec::<(f32, BodyId), MAX_DRY>::new();
        let (mut of, mut far) = (0, 0);
        for dry @ Dry { body, .. } in &self.list {
            let Some(place) = place(*body) else { continue };
            if !seen(dry, place) {
                far += 1;
                continue;
            }
            of += 1;
            let off = views.iter().map(|view| view.eye.distance_squared(place)).fold(f32::INFINITY, f32::min);
            let at = near.iter().position(|(other, _)| off < *other).unwrap_or(near.len());
            if at < MAX_DRY {
                if near.is_full() {
                    near.pop();
                }
                near.insert(at, (off, *body));
            }
        }
        (DryPlan { bodies: near.into_iter().map(|(_, body)| body).collect(), of, changes: self.changes }, far)
    }
}

impl Dry {
    /// The longest distance within it, metres.
    pub(crate) fn size(&self) -> f32 {
        let (low, high) = self.hull.bounds();
        low.distance(high)
    }
}

impl DryPlan {
    /// What the table holds once it is written for this moment.
    pub(crate) fn mark(&self, tick: u64, alpha: f32) -> DryMark {
        DryMark { moment: (!self.bodies.is_empty()).then_some((tick, alpha)), changes: self.changes }
    }

    /// Whether the table must be written, which held this.
    pub(crate) fn differs(&self, shown: DryMark, plan: &FramePlan) -> bool {
        self.of > self.bodies.len() || shown != self.mark(plan.tick, plan.alpha)
    }
}

/// A local point in the frame of a hull that stands at `pose`.
fn to_hull(pose: Pose, point: Vec3) -> Vec3 {
    pose.orientation.inverse() * (point - pose.position)
}

impl OpenWater {
    /// Keeps a body's hull dry: no water is drawn, and [`Self::is_dry`] is true, in the room that [`Hull::dry`] tells; `None` lets
    /// the water show again, as it does by default. Water that stands over the rim shows. Changes looks alone, nothing
    /// that is simulated.
    ///
    /// A frame draws the 16 hulls nearest to its views; bodies of one hull share a raster of 48 KiB.
    ///
    /// [`Hull::dry`]: crate::Hull::dry
    ///
    /// # Errors
    /// There is no such body, or the device has no room for the raster; then nothing was changed.
    pub fn set_dry(&mut self, id: BodyId, hull: Option<DryHull>) -> Result<(), OpenWaterError> {
        self.bodies.body(id)?;
        let mut dry = self.dry.clone();
        dry.set(id, hull);
        #[cfg(feature = "gpu")]
        if let Some(gpu) = &mut self.gpu {
            gpu.set_dry(dry.rasters())?;
        }
        self.dry = dry;
        Ok(())
    }

    /// Whether a local point lies in a hull that is kept dry, after the last tick; `surface_is_dry` in WGSL is the same at
    /// the drawn moment. Spray and splashes need not start there.
    pub fn is_dry(&self, point: Vec3) -> bool {
        let inside = |dry: &Dry| {
            let pose = self.bodies.drawn(dry.body, 1.0);
            pose.is_some_and(|pose| dry.hull.contains(to_hull(pose, point)))
        };
        self.dry.list.iter().any(inside)
    }
}
