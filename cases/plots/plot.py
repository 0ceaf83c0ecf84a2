#!/usr/bin/env python3
"""Pictures of one run: section.png, history.png and traction.png (the last two once per body).

  plot.py runs/hcc-oblique
  plot.py runs/hcc-oblique --out pictures
"""
from pathlib import Path

import script
from script import BLACK, COMPONENT_COLOURS, plt

import matplotlib.colors
import matplotlib.ticker
import matplotlib.tri
import numpy as np

from run_directory import Frames, RunDirectory

INTACT = "#cfe3f1"  # ice without damage
DAMAGED = "#8c2d04"


def main():
    parser = script.Parser(description=__doc__, formatter_class=script.argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", help="run directory")
    parser.add_argument("--out", type=Path, help="where the pictures go (default: DIRECTORY/plots)")
    arguments = parser.parse_args()
    run = RunDirectory(arguments.directory)
    with Frames(run) as frames:
        out = script.make_directory(arguments.out or run.path / "plots")
        script.save(draw_section(run, frames), out / "section.png")
        for body in run.bodies:
            suffix = f"-{body}" if body else ""
            script.save(draw_history(run, body), out / f"history{suffix}.png")
            script.save(draw_traction(run, frames, body), out / f"traction{suffix}.png")


# ---- section through the ice ----------------------------------------------------------------------------------------

def draw_section(run, frames):
    """The particles of the slice |x - x_body| < one spacing and the bodies' outlines, at up to three stages."""
    shown = stages(run, frames)
    spacing = run.number("spacing_m")
    x = frames.bodies[0].position[0, 0] if frames.bodies else np.median(frames.points(0)[:, 0])
    slices = {frame: np.abs(frames.points(frame)[:, 0] - x) < spacing for frame in shown}
    view = section_view(frames, slices, spacing)
    field = next((f for f in ("plastic_strain", "failed", "von_mises_Pa") if f in frames.fields), None)
    colours = field_colours(frames, field, slices)

    width, height = np.ptp(view[0]), np.ptp(view[1])
    panel = min(4.2, 4.6 * width / height)  # inches
    figure, axes = plt.subplots(1, len(shown), figsize=(len(shown) * panel + 1.9, panel * height / width + 1.5),
                                sharex=True, sharey=True, squeeze=False)
    drawn = []
    for ax, (frame, stage) in zip(axes[0], shown.items()):
        points = frames.points(frame)[slices[frame]]
        values = frames.field(field, frame)[slices[frame]] if field else np.zeros(len(points))
        order = np.argsort(values)  # the damaged ones on top
        drawn.append(ax.scatter(*points[order, 1:].T, c=values[order] * colours["scale"], cmap=colours["cmap"],
                                norm=colours["norm"], linewidths=0, zorder=3))
        for body in frames.bodies:
            outline = body.outline(frame)
            ax.fill(outline[:, 1], outline[:, 2], color="#e4e4e4", zorder=2)
            ax.plot(outline[:, 1], outline[:, 2], color="#222222", linewidth=1.3, zorder=4)
        ax.set(xlim=view[0], ylim=view[1], aspect="equal",
               title=f"{stage}\nt = {1e3 * frames.times[frame]:.3g} ms")
        ax.grid(False)
    label_lengths(axes[0], width)
    bar = figure.colorbar(drawn[-1], ax=list(axes[0]), label=colours["label"], extend=colours["extend"], pad=0.015,
                          aspect=25)
    if field == "failed":
        bar.set_ticks([0, 1], labels=["intact", "failed"])
    figure.suptitle(f"{run.headline()}\nslice x = {x + 0.0:.3g} ± {spacing:.3g} m")
    size_markers(figure, axes[0], drawn, spacing)
    return figure


def stages(run, frames):
    """{frame: name of the stage}: the three stages of Cai et al. (2025), section 4.2, for a body that comes from below
    and gets through; first contact, peak force and end for any other."""
    last = len(frames.times) - 1
    if not frames.bodies:
        return named([(0, "start"), (last, "end")])
    z = frames.points(0)[:, 2]
    half = run.number("spacing_m") / 2
    bottom, top = z.min() - half, z.max() + half
    body = frames.bodies[0]
    reach = np.array([body.outline(frame)[:, 2].max() for frame in range(last + 1)])
    if reach[0] <= bottom + half and reach.max() >= top:
        entered, through = np.argmax(reach >= bottom + (top - bottom) / 3), np.argmax(reach >= top)
        return named([(entered, "collision, depression"), (through, "penetration, perforation"),
                      (last, "through, spray")])
    force = np.linalg.norm(run.force(body.name if len(run.bodies) > 1 else ""), axis=1)
    if not force.any():
        return named([(0, "start"), (last, "end, no contact")])
    time = run.time()
    contact, peak = (np.searchsorted(frames.times, time[row]) for row in (np.argmax(force > 0), np.argmax(force)))
    return named([(min(contact, last), "first contact"), (min(peak, last), "peak force"), (last, "end")])


def named(pairs):
    """Joins the names of stages that fall on the same frame."""
    result = {}
    for frame, name in pairs:
        result[int(frame)] = f"{result[int(frame)]}; {name}" if int(frame) in result else name
    return result


def section_view(frames, slices, spacing):
    """((y0, y1), (z0, z1)) that shows the ice near the bodies and what they throw out, not a whole wide sheet."""
    start = frames.points(0)
    thick = np.ptp(start[:, 2]) + spacing
    z = [start[:, 2].min(), start[:, 2].max()]
    for frame, cut in slices.items():
        z += list(np.quantile(frames.points(frame)[cut, 2], [0.002, 0.998])) if cut.any() else []
        # A body's top counts only if it has come up through the ice: one that lies above would fill the picture.
        z += [body.outline(frame)[:, 2].max() for body in frames.bodies
              if body.outline(0)[:, 2].max() < start[:, 2].mean()]
    z0, z1 = min(z) - 0.7 * thick, max(z) + 0.4 * thick
    outlines = [body.outline(frame) for body in frames.bodies for frame in slices]
    near = [outline[(outline[:, 2] > z0) & (outline[:, 2] < z1), 1] for outline in outlines]
    y = np.concatenate(near) if any(map(len, near)) else start[:, 1]
    low, high = y.min() - 1.6 * thick, y.max() + 1.6 * thick
    return (max(low, start[:, 1].min() - thick), min(high, start[:, 1].max() + thick)), (z0, z1)


def label_lengths(axes, width):
    """Lengths in millimetres where the picture is less than half a metre wide."""
    scale, unit = (1e3, "mm") if width < 0.5 else (1, "m")
    for ax in axes:
        for direction, name in ((ax.xaxis, "y"), (ax.yaxis, "z")):
            direction.set_major_locator(matplotlib.ticker.MaxNLocator(6))
            direction.set_major_formatter(lambda value, _: f"{scale * value:.4g}".replace("-", "\N{MINUS SIGN}"))
            direction.set_label_text(f"{name} [{unit}]")
        ax.label_outer()


def field_colours(frames, field, slices):
    """How a field is coloured. The scale of plastic strain is fixed, so that pictures of different runs compare."""
    def ramp(*colours):
        return matplotlib.colors.LinearSegmentedColormap.from_list("ice", [INTACT, *colours])
    look = {"scale": 1, "extend": "neither", "cmap": ramp(DAMAGED), "norm": plt.Normalize(0, 1), "label": ""}
    if field == "plastic_strain":
        # clip: a logarithm has no colour for the zero of intact ice
        look.update(cmap=ramp("#7fb6d6", "#f2c14e", "#d9622b", "#5f1205"), extend="both",
                    norm=matplotlib.colors.LogNorm(1e-3, 1, clip=True), label="equivalent plastic strain [-]")
    elif field == "failed":
        look.update(cmap=matplotlib.colors.ListedColormap([INTACT, DAMAGED]), norm=plt.Normalize(-0.5, 1.5))
    elif field == "von_mises_Pa":
        highest = max(np.quantile(frames.field(field, f)[cut], 0.99) if cut.any() else 0 for f, cut in slices.items())
        look.update(cmap="viridis", norm=plt.Normalize(0, 1e-6 * highest or 1), scale=1e-6, extend="max",
                    label="von Mises stress [MPa]")
    return look


def size_markers(figure, axes, drawn, spacing):
    """Draws every particle one spacing wide; the size of the axes is known only after the layout."""
    figure.canvas.draw()
    for ax, markers in zip(axes, drawn):
        points_per_metre = ax.get_window_extent().width * 72 / figure.dpi / np.ptp(ax.get_xlim())
        markers.set_sizes([(1.05 * spacing * points_per_metre) ** 2])


# ---- histories ------------------------------------------------------------------------------------------------------

def draw_history(run, body):
    time = 1e3 * run.time()
    force = run.force(body)
    centre, mean = run.filtered_force(body)
    velocity = run.vector("velocity", "m_s", body)
    attitude = run.column("attitude_deg", body)
    spin = run.vector("angular_velocity", "rad_s", body)

    figure, axes = plt.subplots(2, 2, figsize=(11, 6.6), sharex=True)
    panels = ((axes[0, 0], 1e-3 * force, "force of the ice on the body [kN]", 0.6),
              (axes[0, 1], velocity - velocity[0], "change of velocity [m/s]", 1.4),
              (axes[1, 1], spin, "angular velocity [rad/s]", 1.4))
    for ax, values, label, thickness in panels:
        for axis, colour in enumerate(COMPONENT_COLOURS):
            ax.plot(time, values[:, axis], color=colour, linewidth=thickness)
        ax.set_ylabel(label)
    magnitude = 1e-3 * np.linalg.norm(mean, axis=1)
    draw_peak(axes[0, 0], 1e3 * centre, magnitude)
    axes[1, 0].plot(time, attitude - attitude[0], color=BLACK)
    axes[1, 0].set_ylabel("change of attitude angle [°]")
    for ax in axes.flat:
        ax.axhline(0, color="#888888", linewidth=0.6, zorder=0.5)
        ax.set_xlim(0, time[-1])
    for ax in axes[1]:
        ax.set_xlabel("time [ms]")
    handles = [plt.Line2D([], [], color=colour, label=f"{axis} component")
               for axis, colour in zip("xyz", COMPONENT_COLOURS)]
    handles.append(plt.Line2D([], [], color=BLACK, linewidth=2.4,
                              label=f"force magnitude, mean over {1e3 * run.number('force_window_s'):.3g} ms"))
    figure.suptitle(run.headline() + (f"\nbody {body}" if body else ""))
    script.legend_below(figure, handles)
    return figure


def draw_peak(ax, time, magnitude):
    ax.plot(time, magnitude, color=BLACK, linewidth=2.4)
    ax.margins(y=0.1)
    peak = np.argmax(magnitude)
    if magnitude[peak] > 0:
        ax.annotate(f"{magnitude[peak]:.4g} kN", (time[peak], magnitude[peak]), xytext=(6, 4),
                    textcoords="offset points", fontweight="bold")


# ---- traction on the body -------------------------------------------------------------------------------------------

def draw_traction(run, frames, body_name):
    """Largest traction of each boundary particle: as the ice sees the body and, for a round nose, unrolled."""
    body = frames.body(body_name)
    peak = 1e-6 * np.linalg.norm(body.traction, axis=2).max(axis=0)
    axis = loaded_axis(body)
    across, up = viewed_from(axis)
    facing = body.boundary_normal_body @ axis
    seen = facing > 0.02
    if seen.sum() < 3:
        raise script.FileError(f"{frames.path}: body '{body.name}' has fewer than 3 boundary particles facing the ice")
    flat = facing[seen].min() > 0.999
    norm = plt.Normalize(0, peak.max() or 1)

    figure, axes = plt.subplots(1, 1 if flat else 2, figsize=(6 if flat else 11, 4.9), squeeze=False,
                                gridspec_kw={} if flat else {"width_ratios": [1, 1.25]})
    mm = 1e3 * body.boundary_position_body
    colours = draw_map(axes[0, 0], mm[seen] @ across, mm[seen] @ up, peak[seen], norm)
    axes[0, 0].set(aspect="equal", xlabel=f"{axis_name(across)} (body) [mm]", ylabel=f"{axis_name(up)} (body) [mm]",
                   title=f"face towards {axis_name(axis)} (body), seen from the ice")
    if not flat:
        draw_unrolled(axes[0, 1], mm, axis, across, up, seen, peak, norm)
    interval = 1e3 * np.diff(frames.times).max(initial=0)
    figure.colorbar(colours, ax=list(axes[0]), aspect=25, pad=0.02,
                    label=f"peak traction, mean over {interval:.3g} ms [MPa]")
    figure.suptitle(run.headline() + (f"\nbody {body_name}" if body_name else ""))
    return figure


def draw_unrolled(ax, mm, axis, across, up, seen, peak, norm):
    """Angle about the axis against depth behind the foremost point: the nose and half as much of the side behind it."""
    depth = (mm[seen] @ axis).max() - mm @ axis
    strip = depth <= 1.5 * depth[seen].max()
    angle = np.degrees(np.arctan2(mm[strip] @ up, mm[strip] @ across))
    turns = np.concatenate([angle - 360, angle, angle + 360])  # so that the map closes at +-180 degrees
    draw_map(ax, turns, np.tile(depth[strip], 3), np.tile(peak[strip], 3), norm)
    ax.set(xlim=(-180, 180), ylim=(depth[strip].max(), 0), xticks=range(-180, 181, 90),
           xlabel=f"angle about {axis_name(axis)} from {axis_name(across)} towards {axis_name(up)} [°]",
           ylabel="distance behind the tip [mm]", title="unrolled")


def draw_map(ax, x, y, values, norm):
    """Values between scattered particles, interpolated linearly on their triangulation."""
    ax.grid(False)
    return ax.tripcolor(matplotlib.tri.Triangulation(x, y), values, shading="gouraud", cmap="inferno_r", norm=norm)


def loaded_axis(body):
    """The body axis (+-x, +-y or +-z) most nearly against the largest force of the ice; +z if there is none."""
    forces = np.einsum("fpi,p->fi", body.traction, body.boundary_area)
    frame = np.argmax(np.linalg.norm(forces, axis=1))
    force_body = body.rotation[frame].T @ forces[frame]
    axis = np.zeros(3)
    largest = np.argmax(np.abs(force_body)) if force_body.any() else 2
    axis[largest] = 1 if force_body[largest] <= 0 else -1
    return axis


def viewed_from(axis):
    """Body axes that point right and up for somebody who looks at the body against `axis`."""
    up = np.array([0., 1., 0.]) if axis[1] == 0 else np.array([0., 0., 1.])
    return np.cross(up, axis), up


def axis_name(direction):
    largest = np.argmax(np.abs(direction))
    return ("+" if direction[largest] > 0 else "\N{MINUS SIGN}") + "xyz"[largest]


if __name__ == "__main__":
    script.run(main)
