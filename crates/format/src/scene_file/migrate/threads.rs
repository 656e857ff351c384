//! Converts threaded scripts to coroutines that are resumed once per step.

use super::Thread;

const THREAD_MAIN: &str = "sysCall_threadmain";
/// Threads whose whole text was the thread began in the fourth step.
const STEPS_BEFORE_THREADS: u8 = 3;

/// The text with functions in front that run it. Texts without `sysCall_threadmain` are threads as a whole, where they are not `named`
/// threads only.
pub(super) fn coroutine(text: &str, thread: Thread, named: bool) -> String {
    if text.contains(THREAD_MAIN) {
        return host(thread) + &text.replace(THREAD_MAIN, "coroutineMain");
    }
    if named {
        return text.to_owned();
    }
    format!(
        "{} function coroutineMain() {text}\nend\n",
        whole_host(thread)
    )
}

/// Makes the coroutine, and resumes it. As many lines as in the original, since errors tell them.
fn host(thread: Thread) -> String {
    format!(
        "function sysCall_init()\n    corout=coroutine.create(coroutineMain)\nend\n\nfunction sysCall_actuation()\n{}end\n\n",
        resume(thread)
    )
}

/// The same in one line, so that the lines of the text stay.
fn whole_host(thread: Thread) -> String {
    let resume: Vec<String> = resume(thread)
        .split_whitespace()
        .map(str::to_owned)
        .collect();
    format!(
        "local __steps=0 function sysCall_init() corout=coroutine.create(coroutineMain) end function sysCall_actuation() \
         __steps=__steps+1 if __steps>{STEPS_BEFORE_THREADS} then {} end end",
        resume.join(" ")
    )
}

fn resume(thread: Thread) -> String {
    let again = match thread {
        Thread::Once => "",
        Thread::Again => "    else\n        corout=coroutine.create(coroutineMain)\n",
    };
    format!(
        "    if coroutine.status(corout)~='dead' then\n        local ok,errorMsg=coroutine.resume(corout)\n        \
         if errorMsg then\n            error(debug.traceback(corout,errorMsg),2)\n        end\n{again}    end\n"
    )
}

#[cfg(test)]
mod tests {
    use super::{Thread, coroutine};

    #[test]
    fn a_thread_becomes_a_coroutine() {
        let new = coroutine("function sysCall_threadmain()\nend", Thread::Once, false);
        assert!(new.ends_with("function coroutineMain()\nend"), "{new}");
        assert_eq!(new.lines().count(), 13 + 2);
        assert!(!new.contains("else"));
        assert!(
            coroutine("sysCall_threadmain=f", Thread::Again, false)
                .contains("else\n        corout=coroutine.create")
        );
    }

    #[test]
    fn a_text_that_is_a_thread_keeps_its_lines() {
        let new = coroutine("x=1\nsim.wait(1)", Thread::Once, false);
        assert_eq!(new.lines().nth(1), Some("sim.wait(1)"));
        assert!(
            new.lines()
                .next()
                .is_some_and(|line| line.ends_with("function coroutineMain() x=1")),
            "{new}"
        );
        assert_eq!(
            coroutine("x=1", Thread::Once, true),
            "x=1",
            "nothing says that this is a thread"
        );
    }
}
