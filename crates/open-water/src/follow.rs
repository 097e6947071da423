//! What grids' windows stay around: a body, a place the game sets, what a camera sees, or a fixed place.

use glam::{DVec2, Vec3};

use crate::grids::Grid;
use crate::water::OpenWater;
use crate::{BodyId, GridId, OpenWaterError};

/// What a grid's window stays around.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Follow {
    /// A body; the window stays where it is when the body is gone.
    Body(BodyId),
    /// A place that the game sets ([`OpenWater::set_follow_point`]); until then the window stays around the world's origin.
    Point,
    /// The part of the view ([`OpenWater::look`]) nearest the eye that fits the window; until then as [`Self::Point`].
    View,
    /// A place in the world (x, z), metres.
    Fixed(DVec2),
}

/// How a camera looks at the water: where grids with [`Follow::View`] go and what is near enough to matter. The game says
/// it itself, as drawing never changes what is simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Look {
    /// The eye's local position, metres.
    pub eye: Vec3,
    /// Where it looks, of any length. The picture's lower edge is taken to be level.
    pub direction: Vec3,
    /// Vertical field of view, radians, 0.01 to 3.
    pub fov_y: f32,
    /// Width of the picture over its height, 0.01 to 100.
    pub aspect: f32,
}

/// Lowest an eye is taken to be above the water, metres.
const LOWEST: f64 = 0.5;
/// Rays flatter than this, radians, end here: a view to the horizon is as long as a window is.
const FLATTEST: f64 = 1e-4;
/// A window narrower than the view takes this share of its shorter side across, so that some of it is left to reach ahead.
const ACROSS: f64 = 1.0 / 3.0;

impl Look {
    pub(crate) fn is_sane(&self) -> bool {
        let [fov, aspect] = [self.fov_y, self.aspect];
        self.eye.is_finite()
            && self.direction.is_finite()
            && self.direction.length_squared() > 1e-12
            && (0.01..=3.0).contains(&fov)
            && (0.01..=100.0).contains(&aspect)
    }

    /// Middle of the smallest rectangle along x and z around the part of the view's footprint on the water at `level`
    /// that is nearest the eye and fits into `room` metres. `None` when no water is in view.
    pub(crate) fn middle(&self, level: f32, room: DVec2) -> Option<DVec2> {
        let eye = DVec2::new(self.eye.x.into(), self.eye.z.into());
        let d = self.direction.as_dvec3().normalize();
        // From below, the surface is seen as from above in a mirror.
        let over = f64::from(self.eye.y) - f64::from(level);
        let down = if over < 0.0 { d.y } else { -d.y };
        let height = over.abs().max(LOWEST);
        let ahead = DVec2::new(d.x, d.z).try_normalize().unwrap_or(DVec2::X);
        let side = ahead.perp();
        let pitch = libm::asin(down.clamp(-1.0, 1.0));
        let half = 0.5 * f64::from(self.fov_y);
        // How far ahead of the eye a ray, so steep below the horizon, meets the water.
        let reach = |steep: f64| height / libm::tan(steep);
        let (lowest, highest) = (pitch + half, pitch - half);
        if lowest <= FLATTEST {
            return None;
        }
        let first = reach(lowest.min(std::f64::consts::PI - FLATTEST));
        let last = if highest <= FLATTEST { f64::INFINITY } else { reach(highest) };
        // Half the picture's width at the distance of the water `s` metres ahead.
        let slope = f64::from(self.aspect) * libm::tan(half);
        let narrow = ACROSS * room.min_element();
        let width = |s: f64| (slope * (s * libm::cos(pitch) + height * libm::sin(pitch))).clamp(0.0, narrow);
        // The rectangle around what is at most `far` metres ahead or behind.
        let around = |far: f64| {
            let ends = [first.max(-far), last.min(far)];
            let corners = ends.map(|s| [ahead * s - side * width(s), ahead * s + side * width(s)]);
            let all = corners.as_flattened();
            let low = all.iter().fold(DVec2::INFINITY, |a, b| a.min(*b));
            let high = all.iter().fold(DVec2::NEG_INFINITY, |a, b| a.max(*b));
            (low, high)
        };
        let nearest = if first > 0.0 { first } else { (-last).max(0.0) };
        let (mut near, mut far) = (nearest, nearest + room.length());
        for _ in 0..40 {
            let middle = 0.5 * (near + far);
            let (low, high) = around(middle);
            if (high - low).cmple(room).all() { near = middle } else { far = middle }
        }
        let (low, high) = around(near);
        Some(eye + 0.5 * (low + high))
    }
}

impl Grid {
    /// The place that its window is to stand around, if there is one.
    pub(crate) fn target(
        &self,
        look: Option<&Look>,
        level: f32,
        body: impl Fn(BodyId) -> Option<Vec3>,
    ) -> Option<DVec2> {
        match self.desc.follow {
            Follow::Fixed(place) => Some(place),
            Follow::Body(id) => body(id).map(|p| self.origin + DVec2::new(p.x.into(), p.z.into()) + self.trail),
            Follow::Point => self.point,
            Follow::View => Some(self.origin + look?.middle(level, self.room())?),
        }
    }
}

impl OpenWater {
    /// Says where the grid's window is to stay around from the next tick on, world (x, z), metres. A place that is not
    /// finite is ignored.
    ///
    /// # Errors
    /// There is no such grid, or it does not follow a [`Follow::Point`].
    pub fn set_follow_point(&mut self, id: GridId, place: DVec2) -> Result<(), OpenWaterError> {
        if self.grids.present(id)?.desc.follow != Follow::Point {
            return Err(OpenWaterError::NotAPoint(id));
        }
        // Waves that leave do so in the same window.
        let meant = |grid: &&mut Grid| grid.id == id || (grid.ebbs() && grid.into == Some(id));
        for grid in self.grids.iter_mut().filter(meant).filter(|_| place.is_finite()) {
            grid.point = Some(place);
        }
        note!(self, Input::Point(id, place));
        Ok(())
    }

    /// Says how the game looks at the water, for the ticks to come. What is out of range is ignored.
    pub fn look(&mut self, look: Look) {
        if look.is_sane() {
            self.looking = Some(look);
            note!(self, Input::Look(look));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOOK: Look = Look { eye: Vec3::new(10.0, 5.0, -20.0), direction: Vec3::X, fov_y: 0.8, aspect: 1.6 };

    /// Local offset of the middle for a direction and room.
    fn middle(direction: Vec3, room: DVec2) -> Option<DVec2> {
        let look = Look { direction, ..LOOK };
        Some(look.middle(0.0, room)? - DVec2::new(10.0, -20.0))
    }

    #[test]
    fn a_level_view_begins_where_the_lowest_ray_meets_the_water() {
        // The lowest ray meets it 5/tan(.4) = 11.83 m ahead; along x the window reaches from there to 60 m on.
        let at = middle(Vec3::X, DVec2::new(60.0, 300.0)).unwrap();
        assert!((at.x - (11.826 + 30.0)).abs() < 0.01 && at.y.abs() < 1e-9, "{at}");
        // As wide as high: 60 m ahead the view is wider than 60 m, which the window cannot hold, and takes a third of.
        let at = middle(-Vec3::Z, DVec2::splat(60.0)).unwrap();
        assert!(at.x.abs() < 1e-9 && (at.y + 11.826 + 30.0).abs() < 0.01, "{at}");
    }

    #[test]
    fn a_view_straight_down_is_centred_under_the_eye() {
        let at = middle(-Vec3::Y, DVec2::splat(60.0)).unwrap();
        assert!(at.length() < 1e-6, "{at}");
    }

    #[test]
    fn a_view_of_the_sky_has_no_middle() {
        assert_eq!(middle(Vec3::new(0.2, 1.0, 0.0), DVec2::splat(60.0)), None);
    }

    #[test]
    fn the_middle_moves_steadily_as_the_view_turns_and_tilts() {
        let room = DVec2::new(60.0, 40.0);
        for (from, to) in [(Vec3::X, Vec3::Z), (Vec3::X, -Vec3::Y), (-Vec3::Y, -Vec3::X)] {
            let mut last: Option<DVec2> = None;
            for i in 0..=2000 {
                let direction = from.lerp(to, i as f32 / 2000.0);
                let at = middle(direction, room).unwrap();
                let step = last.map_or(0.0, |last| last.distance(at));
                assert!(at.is_finite() && step < 0.6, "{step} m at {direction}");
                last = Some(at);
            }
        }
    }
}
