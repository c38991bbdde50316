//! Fault injection for testing recovery: `GLIMRAY_FAULT=device@3` loses the device at the third submission,
//! `device@3,7` also at the seventh; `allocation@2` fails the second allocation; `dispatch@2` omits part of the
//! second dispatch that traces rays; `device@*` fails every time.

use std::sync::{
    OnceLock,
    atomic::{AtomicU32, Ordering},
};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Site {
    Device,
    Allocation,
    Dispatch,
}

struct Plan {
    site: Site,
    /// The occurrences that fail, counted from 1; `None` for all.
    at: Option<Vec<u32>>,
    seen: AtomicU32,
}

/// Whether this occurrence should fail.
pub(super) fn should_fail(site: Site) -> bool {
    static PLAN: OnceLock<Option<Plan>> = OnceLock::new();
    let plan = PLAN.get_or_init(|| parse(&std::env::var("GLIMRAY_FAULT").ok()?));
    let Some(plan) = plan.as_ref().filter(|plan| plan.site == site) else {
        return false;
    };
    let occasion = plan.seen.fetch_add(1, Ordering::Relaxed) + 1;
    plan.at.as_ref().is_none_or(|at| at.contains(&occasion))
}

fn parse(text: &str) -> Option<Plan> {
    let (site, at) = text.split_once('@')?;
    let site = match site {
        "device" => Site::Device,
        "allocation" => Site::Allocation,
        "dispatch" => Site::Dispatch,
        _ => return None,
    };
    let at = if at == "*" {
        None
    } else {
        Some(
            at.split(',')
                .map(str::parse)
                .collect::<Result<_, _>>()
                .ok()?,
        )
    };
    Some(Plan {
        site,
        at,
        seen: AtomicU32::new(0),
    })
}
