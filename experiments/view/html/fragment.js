// Keeps the whole state of the page in its address, after the #: opening the address again restores
// it.

const VIEW_FIELDS = ['mode', 'current', 'compare', 'error', 'stops', 'tone', 'log', 'wipe',
                     'opacity'];
const FRAGMENT_INTERVAL_MS = 700;

function stateForAddress(state, viewer, settings) {
  // Without settings there are images of files, of which only a table can be chosen.
  const panes = (settings.length ? state.panes : []).map(pane => {
    const kept = {layer: pane.layer || '', source: pane.source};
    for (const key of settings) kept[key] = pane[key];
    const changed = pane.parameters.filter(info => info.is_set);
    kept.parameters = Object.fromEntries(changed.map(({name, value}) => [name, value]));
    return kept;
  });
  const view = Object.fromEntries(VIEW_FIELDS.map(key => [key, viewer.state[key]]));
  view.exposure = viewer.painter.exposure;
  const {fitted, x, y, scale} = viewer.camera;
  if (!fitted) view.zoom = [x, y, scale].map(value => Number(value.toPrecision(6)));
  const lights = state.lights.filter(({factor}) => factor !== 1);
  const transport = state.transport.filter(info => info.is_set);
  const materials = state.materials.map(({name, bases, parameters}) => {
    const set = parameters.filter(info => info.is_set);
    return {name, bases, set: Object.fromEntries(set.map(info => [info.name, info.value]))};
  }).filter(({set}) => Object.keys(set).length);
  return {panes, materials, camera: state.camera, width: state.width, height: state.height,
          lights: Object.fromEntries(lights.map(({name, factor}) => [name, factor])),
          transport: Object.fromEntries(transport.map(({name, value}) => [name, value])),
          table: state.table, paused: state.paused, view};
}

const fragmentOf = kept => `#${encodeURIComponent(JSON.stringify(kept))}`;

const isObject = value => value !== null && typeof value === 'object';
const isKept = kept => isObject(kept) && Array.isArray(kept.panes) && kept.panes.every(isObject);

// Returns null if there is no fragment or it was not made by this page.
function readFragment(hash) {
  if (hash.length < 2) return null;
  try {
    const kept = JSON.parse(decodeURIComponent(hash.slice(1)));
    return isKept(kept) ? kept : null;
  } catch {
    return null;
  }
}

// Returns the commands that lead from `state` to the kept state.
function commandsTowards(kept, state, settings) {
  if (!settings.length) {
    return kept.table && kept.table !== state.table ? [{do: 'table', name: kept.table}] : [];
  }
  const commands = [];
  const differs = (a, b) => JSON.stringify(a) !== JSON.stringify(b);
  kept.panes.slice(0, state.panes.length).forEach((want, pane) => {
    const is = state.panes[pane];
    let isOther = false;
    for (const key of settings) {
      if (!(key in want) || (!isOther && want[key] === is[key])) continue;
      commands.push({do: 'set', pane, key, value: want[key]});
      isOther = isOther || key === 'integrator';  // another integrator has another mode, too
    }
    const wanted = want.parameters || {};
    for (const info of is.parameters) {
      if (info.is_set && !(info.name in wanted)) {
        commands.push({do: 'parameter', pane, name: info.name, value: null});
      }
    }
    for (const [name, value] of Object.entries(wanted)) {
      const info = is.parameters.find(one => one.name === name);
      if (info && info.is_set && !isOther && !differs(info.value, value)) continue;
      commands.push({do: 'parameter', pane, name, value});
    }
    if (typeof want.source === 'string' && want.source !== is.source) {
      commands.push({do: 'set', pane, key: 'source', value: want.source});
    }
    if ((want.layer || '') !== (is.layer || '')) {
      commands.push({do: 'layer', pane, name: want.layer || ''});
    }
  });
  if (kept.width > 0 && (kept.width !== state.width || kept.height !== state.height)) {
    commands.push({do: 'resolution', width: kept.width, height: kept.height});
  }
  for (const {name, value, default: fallback} of kept.transport ? state.transport : []) {
    const wanted = kept.transport[name] ?? fallback;
    if (wanted !== value) commands.push({do: 'transport', name, value: wanted});
  }
  if (Array.isArray(kept.materials)) {
    for (const material of state.materials) {
      const of = kept.materials.find(({name, bases}) => name === material.name &&
                                                        bases === material.bases);
      commands.push(...commandsOfMaterial(material, of && isObject(of.set) ? of.set : {}));
    }
  }
  for (const {name, factor} of state.lights) {
    const wanted = (kept.lights || {})[name] ?? 1;
    if (wanted !== factor) commands.push({do: 'light', name, factor: wanted});
  }
  if (kept.camera && differs(kept.camera, state.camera)) {
    commands.push({do: 'camera', ...kept.camera});
  }
  if (typeof kept.paused === 'boolean' && kept.paused !== state.paused) {
    commands.push({do: 'pause', on: kept.paused});
  }
  return commands;
}

// Returns the commands that give a material what is wanted to be set. Another kind drops what was
// set before.
function commandsOfMaterial(material, wanted) {
  const is = Object.fromEntries(material.parameters.filter(info => info.is_set).map(
      info => [info.name, info.value]));
  const isOther = wanted.kind !== is.kind, commands = [];
  if (isOther) commands.push(materialCommand(material, 'kind', wanted.kind ?? null));
  for (const name of Object.keys(is)) {
    if (!isOther && !(name in wanted)) commands.push(materialCommand(material, name, null));
  }
  for (const [name, value] of Object.entries(wanted)) {
    if (name !== 'kind' && (isOther || is[name] !== value)) {
      commands.push(materialCommand(material, name, value));
    }
  }
  return commands;
}

function applyView(view, viewer) {
  const known = VIEW_FIELDS.filter(key => view && key in view &&
                                   typeof view[key] === typeof viewer.state[key]);
  const change = Object.fromEntries(known.map(key => [key, view[key]]));
  for (const key of ['current', 'compare']) if (!viewer.images[change[key]]) delete change[key];
  if (!ERROR_ORDER.includes(change.error)) delete change.error;
  viewer.set(change);
  // The state's own exposure is the brightness at the time this page was opened: the kept exposure
  // wins.
  if (view && view.exposure > 0 && Number.isFinite(view.exposure)) viewer.setExposure(view.exposure);
  if (view && Array.isArray(view.zoom) && view.zoom.every(Number.isFinite)) {
    const [x, y, scale] = view.zoom;
    Object.assign(viewer.camera, {fitted: false, x, y, scale});
    viewer.redraw();
  }
}
