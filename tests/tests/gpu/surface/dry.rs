//! Hulls that are kept dry: `surface_is_dry` against its twin, and no water drawn in them.

use glam::{Quat, Vec2, Vec3};
use open_water::{
    BodyDesc, BodyId, BodyState, BodyStates, Closure, Consumers, GridDesc, Hull, OpenWater, Pose, TriMesh, View, Work,
};
use open_water_shaders::pipeline::{Slot, bind_group, group_layout, pipeline_layout};
use open_water_shaders::surface;
use water_view::{Camera, ViewDesc, ViewParams, WaterView};

use super::calm;
use crate::context::Context;
use crate::view_stage::frame_with;

const DT: f32 = 1.0 / 60.0;

/// The water in bind group 1, the points in group 0.
const PROBE: &str = "
@group(0) @binding(0) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> answers: array<u32>;
@compute @workgroup_size(64) fn probe(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&points) {
        answers[id.x] = u32(surface_is_dry(points[id.x].xyz));
    }
}";

fn probe(context: &Context, water: &OpenWater, points: &[Vec3]) -> Vec<bool> {
    let device = &context.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl((surface::wgsl(1) + PROBE).into()),
    });
    let layout = group_layout(device, "probe", wgpu::ShaderStages::COMPUTE, &[Slot::Read, Slot::ReadWrite]);
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&pipeline_layout(device, "probe", &[&layout, water.surface_layout().unwrap()])),
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    });
    let points: Vec<_> = points.iter().map(|p| p.extend(0.0)).collect();
    let (input, output) = (context.buffer(&points), context.buffer(&vec![7u32; points.len()]));
    let group = bind_group(device, "probe", &layout, &[input.as_entire_binding(), output.as_entire_binding()]);
    context.submit(|encoder| {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.set_bind_group(1, water.surface_bind_group().unwrap(), &[]);
        pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
    });
    context.read::<u32>(&output).into_iter().map(|a| if a < 2 { a == 1 } else { panic!("not answered: {a}") }).collect()
}

fn launch() -> Hull {
    let bytes = include_bytes!("../../../../examples/assets/hulls/launch.glb");
    Hull::from_mesh(&TriMesh::from_bytes("launch.glb", bytes).unwrap(), Closure::Cap).unwrap()
}

struct Boats {
    water: OpenWater,
    store: BodyStates,
    ids: Vec<BodyId>,
}

impl Boats {
    /// Boats in a row on calm water, each heeled and pitched otherwise; bodies of `hull` as heavy as a quarter of it.
    fn new(context: &Context, hull: &Hull, count: u16) -> Self {
        let mut water = OpenWater::new(&context.device, &context.queue, calm()).unwrap();
        let (mut store, mut ids) = (BodyStates::default(), Vec::new());
        for i in 0..count {
            let id = water.add_body(BodyDesc::from_hull(hull, 0.24 * 1025.0 * hull.volume())).unwrap();
            let turn = Quat::from_rotation_y(f32::from(i)) * Quat::from_rotation_x(0.5) * Quat::from_rotation_z(-0.2);
            let state = BodyState { orientation: turn, ..BodyState::at_rest(Vec3::new(f32::from(i) * 12.0, 0.1, 0.0)) };
            store.insert(id, state);
            ids.push(id);
        }
        Self { water, store, ids }
    }

    /// Runs a tick and draws its end.
    fn frame(&mut self, context: &Context, eye: Vec3) -> String {
        for tick in self.water.advance(DT) {
            self.water.tick(tick, &mut self.store).unwrap();
        }
        let mut plan = self.water.plan(&[View { eye, pixel_angle: 1e-3 }], Consumers::NORMALS);
        plan.alpha = 1.0;
        context.submit(|encoder| self.water.encode(&plan, encoder));
        plan.to_string()
    }

    fn pose(&self, boat: usize) -> Pose {
        let (state, body) = (self.store.get(self.ids[boat]).unwrap(), self.water.body(self.ids[boat]).unwrap());
        Pose {
            position: state.position - state.orientation * body.desc().center_of_mass,
            orientation: state.orientation,
        }
    }

    /// Points in and around a boat.
    fn around(&self, boat: usize) -> Vec<Vec3> {
        let unit = |i: u32| (i as f32 * Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5)).fract() - 0.5;
        (0..4_000).map(|i| self.pose(boat).position + unit(i) * Vec3::new(10.0, 3.0, 10.0)).collect()
    }
}

/// Both sides' answers to points about every boat must agree but within rounding of the room's edge.
fn compare(context: &Context, boats: &Boats, listed: &[usize]) -> u32 {
    let mut dry = 0;
    for boat in listed {
        let points = boats.around(*boat);
        for (p, found) in points.iter().zip(probe(context, &boats.water, &points)) {
            let at_edge = || {
                [Vec3::X, Vec3::Y, Vec3::Z]
                    .iter()
                    .any(|a| boats.water.is_dry(p + 1e-3 * a) != boats.water.is_dry(p - 1e-3 * a))
            };
            assert!(found == boats.water.is_dry(*p) || at_edge(), "{p}: {found}");
            dry += u32::from(found);
        }
    }
    dry
}

#[test]
fn both_sides_agree_on_what_is_dry() {
    let context = Context::new();
    let (hull, ball) = (launch(), Hull::sphere(1.2).unwrap());
    let mut boats = Boats::new(&context, &hull, 3);
    boats.frame(&context, Vec3::ZERO);
    assert_eq!(compare(&context, &boats, &[0, 1, 2]), 0, "by default nothing is dry");
    let room = hull.dry(0.2, 0.02).unwrap();
    boats.water.set_dry(boats.ids[0], Some(room.clone())).unwrap();
    boats.water.set_dry(boats.ids[2], Some(ball.dry(0.0, 0.0).unwrap())).unwrap();
    boats.water.set_dry(boats.ids[1], Some(room)).unwrap();
    let plan = boats.frame(&context, Vec3::ZERO);
    assert!(plan.contains("dry hulls, 3"), "{plan}");
    let all = compare(&context, &boats, &[0, 1, 2]);
    assert!(all > 300, "{all} points");
    // A grid comes: the pool is another, and holds the rasters again.
    boats.water.add_grid(GridDesc::default()).unwrap();
    boats.frame(&context, Vec3::ZERO);
    assert!(compare(&context, &boats, &[0, 1, 2]) > 300);
    // Gone, and not asked for: nothing is dry there.
    let there = [boats.around(1), boats.around(2)].concat();
    boats.water.remove_body(boats.ids[1]).unwrap();
    boats.water.set_dry(boats.ids[2], None).unwrap();
    boats.frame(&context, Vec3::ZERO);
    assert!(probe(&context, &boats.water, &there).iter().all(|dry| !dry));
    assert!(compare(&context, &boats, &[0]) > 100);
    assert!(context.take_errors().is_empty());
}

#[test]
fn the_nearest_hulls_are_drawn_dry_and_the_table_is_written_as_they_move() {
    let context = Context::new();
    let hull = Hull::cuboid(Vec3::new(6.0, 1.2, 2.2)).unwrap();
    let mut boats = Boats::new(&context, &hull, 20);
    let room = hull.dry(0.0, 0.0).unwrap();
    boats.ids.iter().for_each(|id| boats.water.set_dry(*id, Some(room.clone())).unwrap());
    let plan = boats.frame(&context, Vec3::new(300.0, 3.0, 0.0));
    assert!(plan.contains("the nearest 16 of 20"), "{plan}");
    let middles: Vec<Vec3> = (0..20).map(|i| boats.pose(i).position).collect();
    assert!(middles.iter().all(|p| boats.water.is_dry(*p)));
    assert_eq!(probe(&context, &boats.water, &middles), (0..20).map(|i| i >= 4).collect::<Vec<_>>());
    for id in boats.ids.split_off(1) {
        boats.water.set_dry(id, None).unwrap();
    }
    // Calm water and one dry hull: a tick has its table written, a pause nothing.
    boats.frame(&context, Vec3::ZERO);
    assert!(compare(&context, &boats, &[0]) > 100);
    for tick in boats.water.advance(DT) {
        boats.water.tick(tick, &mut boats.store).unwrap();
    }
    let view = [View { eye: Vec3::ZERO, pixel_angle: 1e-3 }];
    let plan = boats.water.plan(&view, Consumers::NORMALS);
    assert_eq!(plan.work[..], [Work::Table], "{plan}");
    context.submit(|encoder| boats.water.encode(&plan, encoder));
    assert!(boats.water.plan(&view, Consumers::NORMALS).work.is_empty());
    assert!(context.take_errors().is_empty());
}

#[test]
fn no_water_is_drawn_in_a_dry_hull_until_it_stands_over_the_rim() {
    const SIZE: [u32; 2] = [320, 180];
    let context = Context::new();
    let hull = launch();
    let mut boats = Boats::new(&context, &hull, 1);
    let desc = ViewDesc::default();
    let mut view = WaterView::new(&context.device, &desc, boats.water.surface_layout().unwrap()).unwrap();
    let camera = Camera { aspect: 16.0 / 9.0, ..Camera::default() }.look_at(Vec3::new(0.0, 9.0, 4.0), Vec3::ZERO);
    let mut params = ViewParams::new(camera.view(desc.reverse_z));
    params.wave_height = 0.0;
    let clip_from_world = params.view.clip_from_view * params.view.view_from_world;
    let mut wet = |boats: &mut Boats| {
        boats.frame(&context, camera.position);
        let surface = boats.water.surface_bind_group().unwrap();
        let picture = frame_with(&context, &mut view, &params, SIZE, |pass, view| view.draw_water(pass, surface));
        let shows = |x: f32, z: f32| {
            let clip = clip_from_world.project_point3(Vec3::new(x, 0.0, z));
            let pixel = Vec2::new(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y) * Vec2::new(320.0, 180.0);
            picture.at(pixel.x as u32, pixel.y as u32)[3] == 255
        };
        let plane = (-60..60).flat_map(|i| (-40..40).map(move |j| (0.07 * i as f32, 0.05 * j as f32)));
        let near = |x: f32, z: f32| {
            // Left out: within two pixels of an edge.
            let at = |x, z| boats.water.is_dry(Vec3::new(x, 0.0, z));
            let off = 0.1;
            [(off, 0.0), (-off, 0.0), (0.0, off), (0.0, -off)].iter().any(|d| at(x + d.0, z + d.1) != at(x, z))
        };
        let mut counts = [0, 0];
        for (x, z) in plane.filter(|(x, z)| !near(*x, *z)) {
            let dry = boats.water.is_dry(Vec3::new(x, 0.0, z));
            assert_eq!(shows(x, z), !dry, "{x} {z}");
            counts[usize::from(dry)] += 1;
        }
        counts
    };
    let float = |boats: &mut Boats, y: f32, heel: f32| {
        let turn = Quat::from_rotation_y(0.4) * Quat::from_rotation_x(heel);
        let state = BodyState { orientation: turn, ..BodyState::at_rest(Vec3::new(0.0, y, 0.0)) };
        boats.store.insert(boats.ids[0], state);
    };
    float(&mut boats, 0.2, 0.0);
    assert_eq!(wet(&mut boats)[1], 0, "not dry unless asked");
    boats.water.set_dry(boats.ids[0], Some(hull.dry(0.0, 0.0).unwrap())).unwrap();
    let upright = wet(&mut boats)[1];
    assert!(upright > 2_000, "{upright}");
    float(&mut boats, 0.2, 0.35);
    let heeled = wet(&mut boats)[1];
    assert!(heeled > 1_500, "{heeled}");
    // Awash: the water shows again.
    float(&mut boats, -2.0, 0.0);
    assert_eq!(wet(&mut boats)[1], 0);
    assert!(context.take_errors().is_empty());
}
