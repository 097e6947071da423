//! Who looks at the life, and when: none of it may change the water.

use std::collections::VecDeque;

use glam::Vec3;
use open_water::{Consumers, View};

use super::device::Device;
use super::life::Life;
use crate::evidence::CaseError;
use crate::fixtures::Random;

pub(super) struct Looks {
    random: Random,
    flight: VecDeque<wgpu::SubmissionIndex>,
}

impl Looks {
    pub(super) fn new(seed: u64) -> Self {
        Self { random: Random::new(seed), flight: VecDeque::new() }
    }

    /// What was under way on another device is nothing to wait for.
    pub(super) fn forget(&mut self) {
        self.flight.clear();
    }

    fn chance(&mut self, one_in: f64) -> bool {
        self.random.within(0.0, one_in) < 1.0
    }

    /// Some frames are not planned, some not encoded, some encoders dropped; there are up to four views.
    pub(super) fn frame(&mut self, device: &Device, life: &mut Life) -> Result<(), CaseError> {
        if self.chance(20.0) {
            return Ok(());
        }
        let count = self.random.within(0.0, 5.0) as usize;
        let views: Vec<View> = (0..count).map(|_| self.view()).collect();
        let consumers = Consumers::from_bits_truncate(self.random.within(0.0, 16.0) as u32);
        let plan = life.water.plan(&views, consumers);
        if self.chance(20.0) {
            return Ok(());
        }
        let mut encoder = device.device.create_command_encoder(&Default::default());
        life.water.encode(&plan, &mut encoder);
        if self.chance(20.0) {
            return Ok(());
        }
        device.submit(encoder.finish(), &mut self.flight)
    }

    /// Frames without events, until all is drawn and has come back.
    pub(super) fn rest(&mut self, device: &Device, life: &mut Life) -> Result<(), CaseError> {
        for _ in 0..90 {
            life.idle()?;
            let plan = life.water.plan(&[self.view()], Consumers::all());
            let mut encoder = device.device.create_command_encoder(&Default::default());
            life.water.encode(&plan, &mut encoder);
            device.submit(encoder.finish(), &mut self.flight)?;
        }
        self.flight.clear();
        device.wait()
    }

    fn view(&mut self) -> View {
        let mut number = |reach: f64| self.random.within(-reach, reach) as f32;
        View { eye: Vec3::new(number(200.0), number(50.0), number(200.0)), pixel_angle: 1e-3 }
    }
}
