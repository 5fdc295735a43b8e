// What the page of a run shows beside the replay.

function makeContent(player, choose, go) {
  const whyHolder = make("div", { id: "why", class: "why", hidden: true });
  byId("card").after(whyHolder);
  const why = new Why(whyHolder, choose);
  const timeline = new Timeline(byId("timeline"), byId("span"), player, choose);
  const charts = chartsOf().map((chart) => new Chart(byId("curves"), chart, player));
  showBars(byId("bars"));
  document.querySelector(".key .shelf").closest("li").hidden = !placeBoxes.size;
  byId("figures").append(...data.figures.map(([name, value, note]) => make("div", {},
    make("dt", {}, name), make("dd", { class: "value" }, value),
    note ? make("dd", { class: "note" }, note) : null)));
  showOrders(byId("orders"), choose, go);
  showUse(byId("work"), choose);
  return {
    show: (time, chosen, ink) => {
      why.show(time, chosen);
      timeline.show(time, chosen, ink);
      for (const chart of charts) chart.show(time);
    },
    drawUnder: (ctx, camera, ink, time) => {
      drawShelves(ctx, ink, time);
      drawObstacles(ctx, camera, ink, time);
      for (const robot of robots) drawCarried(ctx, camera, ink, robot, time);
    },
    drawOver: drawFaults,
    /** Whether what a robot carries is drawn around it. */
    showsLoad: (robot, time) => placeBoxes.has(loadAt(robot, time)?.[2]),
    api: {
      /** The chain of causes of a robot at the moment shown, as `clearway explain --json` has it. */
      chain: (id) => chainOf(robotsById.get(id), player.time).map(({ robot, causes, ...link }) =>
        ({ robot: robot.id, for: causes, ...link })),
      /** Name of the shelf in a place at the moment shown, or null. */
      shelf: (place) => shelfIn(place, player.time),
    },
  };
}
