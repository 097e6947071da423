//! The readback ring: newest result with its stamp, drops when full, never stuck.

use open_water_shaders::pipeline::Readback;

use crate::context::Context;

#[test]
fn newest_result_comes_with_its_stamp() {
    let context = Context::new();
    let mut ring = Readback::<u64>::new(&context.device, "ring", 8, 2);
    assert!(ring.poll(&context.device).is_none());
    for tick in 1..=5u64 {
        let source = context.buffer(&[tick as u32, 7, 0, 0]);
        context.submit(|encoder| assert!(ring.encode(encoder, &source, 0, 8, tick)));
        let reading = ring.poll(&context.device).expect("waited for");
        assert_eq!(reading.stamp, tick);
        assert_eq!(bytemuck::pod_collect_to_vec::<u8, u32>(reading.bytes), [tick as u32, 7]);
    }
    assert_eq!(ring.dropped(), 0);
}

#[test]
fn full_ring_drops_and_keeps_order() {
    let context = Context::new();
    let mut ring = Readback::<u64>::new(&context.device, "ring", 4, 2);
    let sources = [1u32, 2, 3].map(|value| context.buffer(&[value, 0, 0, 0]));
    context.submit(|encoder| {
        assert!(ring.encode(encoder, &sources[0], 0, 4, 1));
        assert!(ring.encode(encoder, &sources[1], 0, 4, 2));
        assert!(!ring.encode(encoder, &sources[2], 0, 4, 3), "both slots are in flight");
    });
    let reading = ring.poll(&context.device).expect("waited for");
    assert_eq!((reading.stamp, reading.bytes), (2, &2u32.to_le_bytes()[..]));
    assert_eq!(ring.dropped(), 1);
}

#[test]
fn encoder_dropped_without_submit_frees_its_slot() {
    let context = Context::new();
    let mut ring = Readback::<u64>::new(&context.device, "ring", 4, 1);
    let source = context.buffer(&[9u32, 0, 0, 0]);
    let mut encoder = context.device.create_command_encoder(&Default::default());
    assert!(ring.encode(&mut encoder, &source, 0, 4, 1));
    drop(encoder);
    context.submit(|encoder| assert!(ring.encode(encoder, &source, 0, 4, 2)));
    assert_eq!(ring.poll(&context.device).expect("waited for").stamp, 2);
}
