//! Spans and events of the feature `tracing`, as a small subscriber sees them.

use std::fmt::Write;
use std::sync::Mutex;
use std::thread::ThreadId;

use tracing::field::{Field, Visit};
use tracing::span::{Attributes, Id, Record};
use tracing::{Event, Level, Metadata, Subscriber};

use crate::device::Device;
use crate::{ALL, DT, Game, views};

/// What one thread said, a line each.
static LINES: Mutex<Vec<String>> = Mutex::new(Vec::new());

struct Listener(ThreadId);

struct Line(String);

impl Visit for Line {
    fn record_debug(&mut self, field: &Field, value: &dyn std::fmt::Debug) {
        write!(self.0, " {field}={value:?}").unwrap();
    }
}

impl Listener {
    fn note(&self, start: &str, visit: impl FnOnce(&mut Line)) {
        let mut line = Line(start.to_owned());
        visit(&mut line);
        LINES.lock().unwrap().push(line.0);
    }
}

impl Subscriber for Listener {
    fn enabled(&self, of: &Metadata<'_>) -> bool {
        of.target().starts_with("open_water") && std::thread::current().id() == self.0
    }

    fn register_callsite(&self, _: &'static Metadata<'static>) -> tracing::subscriber::Interest {
        tracing::subscriber::Interest::sometimes()
    }

    fn new_span(&self, span: &Attributes<'_>) -> Id {
        self.note(span.metadata().name(), |line| span.record(line));
        Id::from_u64(1)
    }

    fn event(&self, event: &Event<'_>) {
        let level = if *event.metadata().level() == Level::WARN { "warn" } else { "note" };
        self.note(level, |line| event.record(line));
    }

    fn record(&self, _: &Id, _: &Record<'_>) {}
    fn record_follows_from(&self, _: &Id, _: &Id) {}
    fn enter(&self, _: &Id) {
        self.note("(", |_| {});
    }
    fn exit(&self, _: &Id) {
        self.note(")", |_| {});
    }
}

/// The lines since the last call that begin so.
fn take(start: &str) -> Vec<String> {
    std::mem::take(&mut *LINES.lock().unwrap()).into_iter().filter(|line| line.starts_with(start)).collect()
}

#[test]
fn a_frame_is_told_in_spans_and_what_is_wrong_in_events() {
    tracing::subscriber::set_global_default(Listener(std::thread::current().id())).expect("nobody else listens");
    let device = Device::new();
    let mut game = Game::new(&device);
    game.frame(&device);
    let all = LINES.lock().unwrap().clone();
    for expected in
        ["tick index=1 bodies=1 grids=3", "plan tick=1 views=1", "note dispatches=", "encode tick=1 dispatches="]
    {
        assert_eq!(all.iter().filter(|line| line.starts_with(expected)).count(), 1, "{expected}: {all:#?}");
    }
    let marks = |mark: &str| all.iter().filter(|line| *line == mark).count();
    assert_eq!((marks("("), marks(")")), (3, 3), "{all:#?}");
    assert_eq!(take("warn"), Vec::<String>::new());

    game.tick(5.0);
    let [dropped] = &take("warn")[..] else { panic!("one event") };
    assert!(dropped.contains("dropped_secs=4.8"), "{dropped}");
    let encoders: Vec<_> = (0..10)
        .map(|_| {
            game.tick(DT);
            game.encode(&device, &views(1), ALL)
        })
        .collect();
    assert!(take("warn").iter().any(|line| line.contains("left out") && line.contains("lost=false")));
    device.submit(encoders);
    device.device.destroy();
    for _ in 0..10 {
        game.tick(DT);
        game.encode(&Device::new(), &views(1), ALL);
    }
    assert_eq!(take("warn").iter().filter(|line| line.contains("the device is lost")).count(), 1);
}
