//! The game: every frame something may come, go, change or be nonsense. All of it follows from the seed.

use floating_body::{BodyDesc, Controls, Hull};
use glam::{DVec2, Quat, Vec2, Vec3};
use ocean_spectrum::CascadeDesc;
use open_water::{
    BodyId, BodyState, BodyStates, Consumers, Follow, GridDesc, GridHome, GridId, Look, OpenWater, OpenWaterDesc,
    Preset, Radiation, SeaState, WaterSample, WaterSnapshot,
};

use super::device::Device;
use crate::evidence::CaseError;
use crate::fixtures::{Random, boat_hull};

/// Most bodies and grids at a time.
const MOST: [usize; 2] = [24, 5];
/// Where grids on the GPU are, m: far from every body, which would feel them as late as the device is.
const AFAR: f64 = 20e3;

pub(super) struct Life {
    pub(super) water: OpenWater,
    bodies: BodyStates,
    random: Random,
    hulls: [Hull; 2],
    afloat: Vec<BodyId>,
    /// And whether each is afar, where it may be homed on the device.
    grids: Vec<(GridId, bool)>,
    answers: Vec<WaterSample>,
    saved: Option<Saved>,
    pub(super) events: usize,
}

/// A moment to go back to.
struct Saved {
    water: WaterSnapshot,
    bodies: BodyStates,
    afloat: Vec<BodyId>,
    grids: Vec<(GridId, bool)>,
}

impl Life {
    pub(super) fn new(device: &Device, seed: u64) -> Result<Self, CaseError> {
        let desc = OpenWaterDesc {
            cascades: vec![CascadeDesc::new(32, 120.0), CascadeDesc::new(32, 18.0)],
            ..Preset::Low.water()
        };
        Ok(Self {
            water: OpenWater::new(&device.device, &device.queue, desc)?,
            bodies: BodyStates::default(),
            random: Random::new(seed),
            hulls: [boat_hull()?, Hull::cuboid(Vec3::new(1.25, 0.8, 1.0))?],
            afloat: Vec::new(),
            grids: Vec::new(),
            answers: vec![WaterSample::default(); 8],
            saved: None,
            events: 0,
        })
    }

    fn number(&mut self, low: f64, high: f64) -> f32 {
        self.random.within(low, high) as f32
    }

    fn which(&mut self, count: usize) -> usize {
        self.random.within(0.0, count as f64) as usize
    }

    /// One frame: an event in every fourth, then the ticks that are due.
    pub(super) fn frame(&mut self) -> Result<(), CaseError> {
        if self.which(4) == 0 {
            self.event()?;
            self.events += 1;
        }
        let dt = match self.which(200) {
            0 => 5.0,
            1 => f32::NAN,
            2 => 0.0,
            _ => self.number(1.0 / 240.0, 1.0 / 20.0),
        };
        self.run(dt)
    }

    /// A frame without events.
    pub(super) fn idle(&mut self) -> Result<(), CaseError> {
        self.run(1.0 / 60.0)
    }

    fn run(&mut self, dt: f32) -> Result<(), CaseError> {
        for tick in self.water.advance(dt) {
            self.water.tick(tick, &mut self.bodies)?;
        }
        Ok(())
    }

    /// Takes everything away.
    pub(super) fn leave(&mut self) -> Result<(), CaseError> {
        self.saved = None;
        for id in self.afloat.drain(..) {
            self.water.remove_body(id)?;
            self.bodies.remove(id);
        }
        for (id, _) in self.grids.drain(..) {
            self.water.remove_grid(id)?;
        }
        Ok(())
    }

    /// How many answers of the water and bodies as it has them are not finite.
    pub(super) fn broken(&mut self) -> usize {
        let points: [Vec2; 8] = std::array::from_fn(|i| Vec2::from_angle(i as f32) * 6.0 * i as f32);
        self.water.sample(&points, &mut self.answers);
        let sane = |s: &&WaterSample| !(s.height.is_finite() && s.normal.is_finite() && s.velocity.is_finite());
        let state = |id: &&BodyId| self.water.body(**id).is_ok_and(|body| !body.state().position.is_finite());
        self.answers.iter().filter(sane).count() + self.afloat.iter().filter(state).count()
    }

    /// The device is gone, and another takes its place some frames later.
    pub(super) fn lose_device(&mut self, next: &Device) -> Result<(), CaseError> {
        self.water.lose_device();
        for _ in 0..3 {
            self.idle()?;
            let mut encoder = next.device.create_command_encoder(&Default::default());
            self.water.encode(&self.water.plan(&[], Consumers::all()), &mut encoder);
        }
        self.water.replace_device(&next.device, &next.queue)?;
        Ok(())
    }

    /// What a device compiles once is there before anything is counted.
    pub(super) fn compile(&mut self) {
        while !self.water.prepare_gpu_grids() {
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
    }

    fn event(&mut self) -> Result<(), CaseError> {
        match self.which(22) {
            0..=3 if self.afloat.len() < MOST[0] => self.launch(),
            4 | 5 if !self.afloat.is_empty() => self.sink(),
            6 | 7 if !self.afloat.is_empty() => self.move_one(),
            8 if self.grids.len() < MOST[1] => self.add_grid(),
            9 if !self.grids.is_empty() => {
                let id = self.which(self.grids.len());
                self.water.remove_grid(self.grids.swap_remove(id).0)?;
                Ok(())
            }
            10 => {
                let wind = self.number(2.0, 14.0);
                let (to, over) = (self.number(-3.0, 3.0), self.number(0.5, 20.0));
                Ok(self.water.change_sea(SeaState::wind(wind, 50e3, to), over)?)
            }
            11 => {
                let level = self.number(-1.0, 1.0);
                Ok(self.water.set_level(level)?)
            }
            12 => {
                let wind = Vec2::new(self.number(-20.0, 20.0), self.number(-20.0, 20.0));
                Ok(self.water.set_wind(wind)?)
            }
            13 => {
                let eye = Vec3::new(self.number(-100.0, 100.0), self.number(1.0, 20.0), self.number(-100.0, 100.0));
                self.water.look(Look { eye, direction: -eye, fov_y: 1.0, aspect: 1.6 });
                Ok(())
            }
            14 => self.nonsense(),
            15 => self.save_or_restore(),
            16 => self.rebase(),
            17 | 18 => self.change_sea_itself(),
            19 if !self.grids.is_empty() => self.change_grid(),
            _ => self.steer(),
        }
    }

    fn launch(&mut self) -> Result<(), CaseError> {
        let boat = self.which(3) == 0;
        let mut desc = match boat {
            true => BodyDesc::boat(&self.hulls[0], 1500.0, 8.0),
            false => BodyDesc::from_hull(&self.hulls[1], 400.0),
        };
        if self.which(2) == 0 {
            desc.radiation = Radiation::Grid;
        }
        let id = self.water.add_body(desc)?;
        let position = Vec3::new(self.number(-40.0, 40.0), self.number(-1.0, 6.0), self.number(-40.0, 40.0));
        self.bodies.insert(id, BodyState::at_rest(position));
        self.afloat.push(id);
        Ok(())
    }

    fn sink(&mut self) -> Result<(), CaseError> {
        let at = self.which(self.afloat.len());
        let id = self.afloat.swap_remove(at);
        self.water.remove_body(id)?;
        self.bodies.remove(id);
        Ok(())
    }

    /// A teleport, or a push.
    fn move_one(&mut self) -> Result<(), CaseError> {
        let at = self.which(self.afloat.len());
        let far = if self.which(2) == 0 { 60.0 } else { 0.5 };
        let by = Vec3::new(self.number(-far, far), self.number(0.0, 2.0), self.number(-far, far));
        let spin = Vec3::splat(self.number(-2.0, 2.0));
        if let Some(state) = self.bodies.get_mut(self.afloat[at]) {
            state.position = (state.position + by).clamp(Vec3::splat(-80.0), Vec3::splat(80.0));
            state.angular_velocity = spin;
        }
        Ok(())
    }

    fn steer(&mut self) -> Result<(), CaseError> {
        if self.afloat.is_empty() {
            return Ok(());
        }
        let at = self.which(self.afloat.len());
        let (throttle, steering) = (self.number(-1.0, 1.0), self.number(-1.0, 1.0));
        Ok(self.water.set_controls(self.afloat[at], Controls { throttle, steering, ..Controls::default() })?)
    }

    fn add_grid(&mut self) -> Result<(), CaseError> {
        let remote = self.which(3) == 0;
        let follow = match remote {
            true => Follow::Fixed(DVec2::splat(AFAR)),
            false if self.afloat.is_empty() => Follow::View,
            false => {
                let at = self.which(self.afloat.len());
                Follow::Body(self.afloat[at])
            }
        };
        let home = if remote { GridHome::Gpu } else { GridHome::Cpu };
        let cells = 48 + 16 * self.which(4) as u32;
        let desc = GridDesc { follow, home, cells: [cells; 2], ..Preset::Low.grid() };
        let id = self.water.add_grid(desc)?;
        self.grids.push((id, remote));
        Ok(())
    }

    /// Through bytes every other time.
    fn save_or_restore(&mut self) -> Result<(), CaseError> {
        let by_bytes = self.which(2) == 0;
        let Some(Saved { water, bodies, afloat, grids }) = self.saved.take() else {
            let water = self.water.snapshot();
            let (bodies, afloat, grids) = (self.bodies.clone(), self.afloat.clone(), self.grids.clone());
            self.saved = Some(Saved { water, bodies, afloat, grids });
            return Ok(());
        };
        let water = if by_bytes { WaterSnapshot::from_bytes(&water.to_bytes())? } else { water };
        self.water.restore(&water)?;
        (self.bodies, self.afloat, self.grids) = (bodies, afloat, grids);
        Ok(())
    }

    /// All there is moves the other way, so that it comes to lie elsewhere in the world.
    fn rebase(&mut self) -> Result<(), CaseError> {
        let offset = DVec2::new(self.number(-500.0, 500.0).round().into(), self.number(-500.0, 500.0).round().into());
        self.water.rebase(offset)?;
        let offset = offset.as_vec2();
        for id in &self.afloat {
            if let Some(state) = self.bodies.get_mut(*id) {
                state.position -= Vec3::new(offset.x, 0.0, offset.y);
            }
        }
        // And back to the middle, where it is seen.
        if let Some(&id) = self.afloat.first()
            && let Some(state) = self.bodies.get_mut(id)
        {
            state.position = Vec3::new(0.0, 1.0, 0.0);
            self.water.teleport(id, *state)?;
        }
        Ok(())
    }

    fn change_sea_itself(&mut self) -> Result<(), CaseError> {
        let over = self.number(0.0, 5.0);
        match self.which(8) {
            0 => self.water.set_quality(Preset::Low)?,
            1..=3 => {
                let choppiness = self.number(0.0, 1.0);
                self.water.set_choppiness(choppiness, over)?;
            }
            n => {
                let tiles = [[120.0, 18.0], [90.0, 14.0]][n % 2];
                self.water.set_cascades(tiles.map(|tile| CascadeDesc::new(32, tile)).to_vec(), over)?;
            }
        }
        Ok(())
    }

    /// Other cells, or another home.
    fn change_grid(&mut self) -> Result<(), CaseError> {
        let at = self.which(self.grids.len());
        let cells = 48 + 16 * self.which(4) as u32;
        let size = self.number(0.3, 0.8);
        let home = [GridHome::Cpu, GridHome::Gpu][self.which(2)];
        let (id, afar) = &mut self.grids[at];
        match *afar {
            true => self.water.set_grid_home(*id, home)?,
            false => *id = self.water.set_grid_cells(*id, [cells; 2], [size; 2])?,
        }
        Ok(())
    }

    /// What a broken game would say: refused or ignored, and nothing breaks.
    fn nonsense(&mut self) -> Result<(), CaseError> {
        let refused = self.water.set_wind(Vec2::NAN).is_err()
            && self.water.set_level(f32::NAN).is_err()
            && self.water.change_sea(SeaState::wind(f32::NAN, 50e3, 0.0), 1.0).is_err()
            && self.water.add_grid(GridDesc { cells: [0; 2], ..GridDesc::default() }).is_err();
        self.water.sample(&[Vec2::NAN], &mut [WaterSample::default()]);
        if let Some(&id) = self.afloat.first() {
            let state = BodyState { orientation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..BodyState::at_rest(Vec3::NAN) };
            self.bodies.insert(id, state);
            self.water.set_controls(id, Controls { throttle: f32::NAN, ..Controls::default() })?;
        }
        if refused { Ok(()) } else { Err("nonsense was taken for sense".into()) }
    }
}
