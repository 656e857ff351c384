//! Where the time of steps goes, for those who measure: physics and sensors; what is left are scripts and the loop.

use std::cell::Cell;
use std::time::Duration;

use crate::wall_clock;

/// Time that was spent.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Phases {
    /// In the physics, with the callbacks that scripts have there.
    pub physics: Duration,
    /// In pictures of vision sensors and detections of proximity sensors.
    pub sensors: Duration,
}

thread_local! {
    /// None where nobody measures.
    static SPENT: Cell<Option<Phases>> = const { Cell::new(None) };
}

/// Begins to measure the simulators of this thread.
pub fn measure() {
    SPENT.set(Some(Phases::default()));
}

/// Ends it; the time that was spent since.
pub fn measured() -> Phases {
    SPENT.take().unwrap_or_default()
}

/// Does some of the work of the physics.
pub(crate) fn physics<T>(work: impl FnOnce() -> T) -> T {
    timed(work, |spent| &mut spent.physics)
}

/// Does some of the work of a sensor.
pub(crate) fn sensors<T>(work: impl FnOnce() -> T) -> T {
    timed(work, |spent| &mut spent.sensors)
}

fn timed<T>(work: impl FnOnce() -> T, phase: impl FnOnce(&mut Phases) -> &mut Duration) -> T {
    if SPENT.get().is_none() {
        return work();
    }
    let began = wall_clock::now();
    let result = work();
    // Who measures may have stopped meanwhile.
    if let Some(mut spent) = SPENT.get() {
        *phase(&mut spent) += began.elapsed();
        SPENT.set(Some(spent));
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_measured_counts_and_in_its_phase() {
        let pause = || wall_clock::pause(Duration::from_millis(2));
        physics(pause);
        measure();
        sensors(pause);
        let spent = measured();
        assert!(spent.sensors >= Duration::from_millis(2));
        assert_eq!(spent.physics, Duration::ZERO);
        assert_eq!(measured(), Phases::default());
    }
}
