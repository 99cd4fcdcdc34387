// Keeps the whole state of the page in its address, after the #: opening the address again restores
// it.

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
  const lights = state.lights.filter(({factor}) => factor !== 1);
  const transport = state.transport.filter(info => info.is_set);
  const materials = state.materials.map(({name, bases, parameters}) => {
    const set = parameters.filter(info => info.is_set);
    return {name, bases, set: Object.fromEntries(set.map(info => [info.name, info.value]))};
  }).filter(({set}) => Object.keys(set).length);
  return {panes, materials, camera: state.camera, width: state.width, height: state.height,
          lights: Object.fromEntries(lights.map(({name, factor}) => [name, factor])),
          transport: Object.fromEntries(transport.map(({name, value}) => [name, value])),
          table: state.table, paused: state.paused, adaptive: state.adaptive,
          view: viewState(viewer)};
}

const fragmentOf = kept => `#${encodeURIComponent(JSON.stringify(kept))}`;

const isObject = value => value !== null && typeof value === 'object';
const isKept = kept => isObject(kept) && Array.isArray(kept.panes) && kept.panes.every(isObject);

// Returns what a page keeps; null if there is no fragment or no page has made it.
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
    const {to_world, yfov} = kept.camera;
    commands.push({do: 'camera', to_world, yfov});
  }
  for (const [name, command] of [['paused', 'pause'], ['adaptive', 'adaptive']]) {
    if (typeof kept[name] !== 'boolean' || kept[name] === state[name]) continue;
    commands.push({do: command, on: kept[name]});
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
